// The layout that a device is given: what was measured of it, and else what is known of its kind.
#include "upload/layout_choice.h"

#include "support/programs.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

using namespace onde;
using namespace onde::test;

namespace fs = std::filesystem;

namespace {

struct Folder {
    fs::path path = fs::temp_directory_path() / fmt::format("onde-layouts-{}", getpid());
    ~Folder() { fs::remove_all(path); }
};

gpu::DeviceFacts facts_of(const char* name, bool is_cpu, bool is_pocl = false) {
    gpu::DeviceFacts facts;
    facts.name = name;
    facts.is_cpu = is_cpu;
    facts.is_pocl = is_pocl;
    return facts;
}

} // namespace

TEST_CASE("a layout that was remembered is that device's, whatever its kind") {
    const Folder folder;
    const LayoutMemory memory(folder.path);
    const auto cpu = facts_of("some CPU", true, true), gpu = facts_of("some GPU", false);
    CHECK(known_layout(cpu, memory) == BvhLayout::wide);
    CHECK(known_layout(gpu, memory) == BvhLayout::compressed);
    for (const BvhLayout layout : {BvhLayout::binary, BvhLayout::compressed}) {
        memory.remember(gpu, layout);
        CHECK(LayoutMemory(folder.path).recall(gpu) == layout);
        CHECK(known_layout(gpu, memory) == layout);
    }
    CHECK_FALSE(memory.recall(cpu));
    gpu::DeviceFacts updated = gpu;
    updated.driver_version = "another";
    CHECK_FALSE(memory.recall(updated));
}

TEST_CASE("a damaged memory, and none, are as if nothing had been measured") {
    const Folder folder;
    const LayoutMemory memory(folder.path);
    const auto gpu = facts_of("some GPU", false);
    memory.remember(gpu, BvhLayout::binary);
    for (const std::string& content :
         {std::string(), std::string("narrow"), std::string(1000, 'b')}) {
        for (const auto& entry : fs::directory_iterator(folder.path))
            std::ofstream(entry.path(), std::ios::binary) << content;
        CHECK_FALSE(memory.recall(gpu));
    }
    const LayoutMemory nowhere{fs::path()};
    nowhere.remember(gpu, BvhLayout::binary);
    CHECK_FALSE(nowhere.recall(gpu));
}

TEST_CASE("the wide layout is never for a compiler that takes vectors apart") {
    const Folder folder;
    const LayoutMemory memory(folder.path);
    for (const auto& facts : {facts_of("some GPU", false), facts_of("a GPU of PoCL's", false, true),
                              facts_of("a CPU of some other compiler", true)}) {
        INFO(facts.name);
        const auto layouts = layouts_for(facts);
        CHECK(std::ranges::find(layouts, BvhLayout::wide) == layouts.end());
        memory.remember(facts, BvhLayout::wide);
        CHECK(known_layout(facts, memory) != BvhLayout::wide);
    }
}

TEST_CASE("all layouts for a device are measured, and the fastest is chosen") {
    const auto rates = measure_layouts(programs());
    REQUIRE(rates.size() == layouts_for(programs().device().facts()).size());
    const BvhLayout chosen = fastest_layout(rates);
    for (const LayoutRate& rate : rates) {
        INFO(word_of(rate.layout) << ": " << rate.mrays << " Mrays/s");
        CHECK(rate.mrays > 0);
        if (rate.layout != chosen) continue;
        for (const LayoutRate& other : rates) CHECK(other.mrays <= rate.mrays);
    }
}
