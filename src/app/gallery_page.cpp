#include "app/gallery_page.h"

#include "app/markup.h"

#include <fmt/format.h>

#include <algorithm>

namespace onde::app {
namespace {

constexpr const char* STYLE = R"(
body { font: 16px/1.5 Georgia, serif; color: #222; background: #fbfaf7; margin: 0 auto; max-width: 1120px; padding: 24px; }
h1 { font-size: 34px; margin: 0 0 4px; } h2 { font-size: 23px; margin: 0 0 8px; }
header p, .facts { color: #666; } .facts { font-size: 13px; }
nav { columns: 3; font-size: 15px; margin: 16px 0; } nav a { display: block; color: #246; text-decoration: none; }
article { border-top: 1px solid #ccc; padding: 28px 0; display: grid; grid-template-columns: minmax(0, 9fr) minmax(0, 10fr); gap: 28px; }
article > div { min-width: 0; } img { width: 100%; display: block; background: #000; }
.formula { background: #f0ede4; padding: 6px 12px; margin: 6px 0; font-size: 17px; }
table { border-collapse: collapse; width: 100%; font-size: 14px; } th { text-align: left; font-weight: normal; color: #666; }
th, td { padding: 4px 10px 4px 0; vertical-align: top; border-bottom: 1px solid #e4e0d4; } td.because { color: #555; }
.yes { color: #17692b; } .no { color: #b01818; font-weight: bold; }
code, pre { font: 13px/1.4 monospace; } pre { overflow-x: auto; background: #f0ede4; padding: 10px; }
details { font-size: 14px; margin: 8px 0; } summary { cursor: pointer; color: #246; }
@media (max-width: 760px) { article { grid-template-columns: 1fr; } nav { columns: 1; } }
@media print { article { break-inside: avoid; } })";

/// "2.10" after "2.9": by the numbers between the dots.
std::vector<int> section_order(const std::string& section) {
    std::vector<int> numbers{0};
    for (const char c : section) {
        if (c == '.')
            numbers.push_back(0);
        else if (c >= '0' && c <= '9' && numbers.back() < 100000)
            numbers.back() = 10 * numbers.back() + (c - '0');
    }
    return numbers;
}

std::string heading(const Lesson& lesson) {
    if (lesson.section.empty()) return escaped(lesson.title);
    return escaped(lesson.section + " " + lesson.title);
}

std::string check_row(const LessonCheck& check) {
    return fmt::format("<tr><td>{}</td><td>{}</td><td class=\"{}\">{}&nbsp;{}</td></tr>\n"
                       "<tr><td colspan=\"3\" class=\"because\">{}</td></tr>\n",
                       escaped(check.where), escaped(check.expected), check.holds ? "yes" : "no",
                       escaped(check.measured), check.holds ? "✓" : "✗",
                       formula_markup(check.because));
}

std::string check_table(const GalleryEntry& entry) {
    if (entry.checks.empty()) return "";
    std::string html = "<table><tr><th>where</th><th>expected</th><th>measured</th></tr>\n";
    for (const LessonCheck& check : entry.checks) html += check_row(check);
    return html + "</table>\n";
}

std::string left_column(const GalleryEntry& entry) {
    std::string html = fmt::format("<div><a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\"></a>\n"
                                   "<p class=\"facts\">{2}<br><code>{3}</code></p>\n",
                                   escaped(entry.picture), escaped(entry.lesson.title),
                                   escaped(entry.facts), escaped(entry.command));
    for (const std::string& finding : entry.findings)
        html += fmt::format("<p class=\"facts\">{}</p>\n", escaped(finding));
    return html + "</div>\n";
}

std::string right_column(const GalleryEntry& entry) {
    std::string html = fmt::format("<div><h2>{}</h2>\n", heading(entry.lesson));
    for (const std::string& formula : entry.lesson.formulas)
        html += fmt::format("<p class=\"formula\">{}</p>\n", formula_markup(formula));
    html += fmt::format("<p>{}</p>\n", escaped(entry.lesson.says)) + check_table(entry);
    if (!entry.replay.empty())
        html += fmt::format("<details><summary>what became of one ray, in words</summary>"
                            "<pre>{}</pre></details>\n",
                            escaped(entry.replay));
    return html + "</div>\n";
}

std::string summary(const std::vector<GalleryEntry>& entries, const std::string& device) {
    size_t checks = 0, held = 0;
    for (const GalleryEntry& entry : entries) {
        checks += entry.checks.size();
        held += size_t(std::ranges::count_if(entry.checks, &LessonCheck::holds));
    }
    return fmt::format("<p>{} pictures, rendered by Onde {} on {}. {} of {} numbers that the "
                       "scenes state were measured in them.</p>\n",
                       entries.size(), ONDE_VERSION, escaped(device), held, checks);
}

} // namespace

std::string gallery_page(std::vector<GalleryEntry> entries, const std::string& device) {
    std::ranges::stable_sort(
        entries, {}, [](const GalleryEntry& entry) { return section_order(entry.lesson.section); });
    std::string html =
        fmt::format("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">{}\n"
                    "<meta name=\"viewport\" content=\"width=device-width\">\n"
                    "<title>Ray tracing, by its pictures</title><style>{}</style></head>\n<body>\n"
                    "<header><h1>Ray tracing, by its pictures</h1>\n{}</header>\n<nav>\n",
                    GALLERY_MARK, STYLE, summary(entries, device));
    for (const GalleryEntry& e : entries)
        html += fmt::format("<a href=\"#{}\">{}</a>\n", escaped(e.name), heading(e.lesson));
    html += "</nav>\n";
    for (const GalleryEntry& e : entries)
        html += fmt::format("<article id=\"{}\">\n{}{}</article>\n", escaped(e.name),
                            left_column(e), right_column(e));
    return html + "</body></html>\n";
}

} // namespace onde::app
