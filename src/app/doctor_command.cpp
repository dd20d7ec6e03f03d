#include "app/doctor_command.h"

#include "app/device_report.h"
#include "app/interrupt.h"
#include "app/render_request.h"
#include "core/error.h"
#include "core/timer.h"
#include "doctor/check.h"
#include "session/picture_denoiser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <unistd.h>

namespace onde::app {

namespace {

using doctor::Check;
using doctor::Finding;

struct DoctorRequest {
    MachineRequest machine;
    std::vector<std::string> checks; ///< names; empty: all
    bool quick = false, json = false;
};

/// A check that was made.
struct Answer {
    const Check* check;
    Finding finding;
    double seconds;
};

std::vector<std::string> check_names() {
    std::vector<std::string> names;
    for (const Check& check : doctor::all_checks()) names.emplace_back(check.name);
    return names;
}

std::vector<const Check*> wanted_checks(const DoctorRequest& request) {
    std::vector<const Check*> wanted;
    for (const Check& check : doctor::all_checks())
        if (request.checks.empty() || std::ranges::count(request.checks, check.name))
            wanted.push_back(&check);
    return wanted;
}

/// Which check is being made: one line on a terminal, which the answer replaces.
class Announcement {
  public:
    Announcement(const Check& check, size_t number, size_t of) {
        if (!isatty(STDERR_FILENO)) return;
        std::fprintf(stderr, "\ronde: check %zu of %zu, %s...\033[K", number, of, check.name);
        std::fflush(stderr);
    }
    ~Announcement() {
        if (isatty(STDERR_FILENO)) std::fputs("\r\033[K", stderr);
    }
    Announcement(const Announcement&) = delete;
    Announcement& operator=(const Announcement&) = delete;
};

void print_answer(const Answer& answer) {
    const Finding& finding = answer.finding;
    const std::string text = printable(finding.text);
    fmt::print("{:<5} {:<10} {:.6g} {}{}{} ({:.1f} s)\n", finding.passed ? "ok" : "FAIL",
               answer.check->name, finding.value, finding.unit, text.empty() ? "" : ": ", text,
               answer.seconds);
    std::fflush(stdout); // the next may take long
}

Json answer_json(const Answer& answer) {
    return {{"name", answer.check->name},      {"words", answer.check->words},
            {"passed", answer.finding.passed}, {"value", answer.finding.value},
            {"unit", answer.finding.unit},     {"text", answer.finding.text},
            {"seconds", answer.seconds}};
}

const Answer* first_failure(const std::vector<Answer>& answers) {
    const auto failure =
        std::ranges::find_if(answers, [](const Answer& a) { return !a.finding.passed; });
    return failure == answers.end() ? nullptr : &*failure;
}

Json report_json(const Machine& machine, const std::vector<Answer>& answers, double seconds) {
    Json checks = Json::array();
    for (const Answer& answer : answers) checks.push_back(answer_json(answer));
    Json device = device_json(machine.device.facts());
    device["platform"] = machine.device.facts().platform;
    device["platform_version"] = machine.device.facts().platform_version;
    return {{"version", ONDE_VERSION},           {"device", device},
            {"denoiser", found_denoiser()},      {"checks", checks},
            {"passed", !first_failure(answers)}, {"seconds", seconds}};
}

void print_sum(const std::vector<Answer>& answers, double seconds) {
    const auto failed =
        std::ranges::count_if(answers, [](const Answer& a) { return !a.finding.passed; });
    if (const Answer* first = first_failure(answers))
        fmt::print("{} of {} checks failed in {:.0f} s; the first, {}, is nearest to the cause: "
                   "it asks whether {}\n",
                   failed, answers.size(), seconds, first->check->name, first->check->words);
    else
        fmt::print("all {} checks passed in {:.0f} s\n", answers.size(), seconds);
}

/// The answers so far where Ctrl-C came.
std::vector<Answer> make_checks(Machine& machine, const DoctorRequest& request,
                                const StopOnInterrupt& interrupt) {
    const doctor::CheckContext context{machine.programs, request.quick};
    const std::vector<const Check*> wanted = wanted_checks(request);
    std::vector<Answer> answers;
    for (const Check* check : wanted) {
        if (interrupt.requested()) break;
        const Timer timer;
        {
            const Announcement announcement(*check, answers.size() + 1, wanted.size());
            answers.push_back({check, doctor::examine(*check, context), 0});
        }
        answers.back().seconds = timer.seconds();
        if (!request.json) print_answer(answers.back());
    }
    return answers;
}

void run_doctor(const DoctorRequest& request, bool& unfit, bool& interrupted) {
    const StopOnInterrupt interrupt;
    const Timer timer;
    Machine machine = open_machine(request.machine);
    const gpu::DeviceFacts& facts = machine.device.facts();
    if (!request.json) {
        fmt::print("{} ({})\n  {}\n", facts.platform, facts.platform_version, device_text(facts));
        fmt::print("--denoise: {}\n", printable(found_denoiser()));
        std::fflush(stdout);
    }
    const std::vector<Answer> answers = make_checks(machine, request, interrupt);
    interrupted = interrupt.requested();
    unfit = first_failure(answers) != nullptr;
    if (request.json)
        fmt::print("{}", json_text(report_json(machine, answers, timer.seconds())));
    else if (!answers.empty())
        print_sum(answers, timer.seconds());
}

} // namespace

void add_doctor_command(Command& root, bool& unfit, bool& interrupted) {
    Command command = root.add_command("doctor", "Check that a device computes what it should");
    const auto request = std::make_shared<DoctorRequest>();
    std::string checks = "Make these checks only (all, from the ground up):";
    for (const Check& check : doctor::all_checks())
        checks += fmt::format("\n{:<10} {}", check.name, check.words);
    command.option("--check", &request->checks, checks,
                   {.value = "WORD", .delimiter = ',', .words = check_names()});
    command.flag("--quick", request->quick, "Fewer samples, and fewer kernels to compile");
    declare_machine(command, request->machine);
    command.flag("--json", request->json, "Print JSON");
    command.on_run([request, &unfit, &interrupted] { run_doctor(*request, unfit, interrupted); });
}

} // namespace onde::app
