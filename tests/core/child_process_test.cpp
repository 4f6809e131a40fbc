#include "engine/core/child_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace weft {
namespace {

namespace fs = std::filesystem;

class ChildProcess : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "weft_child_XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        folder_ = name;
    }
    void TearDown() override { fs::remove_all(folder_); }
    [[nodiscard]] std::string in(const std::string& name) const {
        return (folder_ / name).string();
    }
    [[nodiscard]] static std::string text_of(const std::string& path) {
        std::ifstream file(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    [[nodiscard]] static int run(const std::vector<std::string>& arguments,
                                 const ProcessOptions& options) {
        const auto child = start_process(arguments, options);
        EXPECT_TRUE(child) << child.error().text();
        return child ? wait_for_process(*child) : -1;
    }
    fs::path folder_;
};

TEST_F(ChildProcess, ReadsAndWritesTheFilesThatItIsGiven) {
    std::ofstream(in("input")) << "two words\n";
    std::ofstream(in("output")) << "a longer text that was there before";
    ProcessOptions options;
    options.folder = folder_.string();
    options.input = in("input");
    options.output = in("output");
    options.errors = in("errors");
    EXPECT_EQ(run({"sh", "-c", "cat; pwd; echo \"$1\" >&2", "sh", "$HOME; true"}, options), 0);
    EXPECT_EQ(text_of(in("output")), "two words\n" + fs::canonical(folder_).string() + "\n");
    EXPECT_EQ(text_of(in("errors")), "$HOME; true\n") << "no shell reads the arguments";
}

TEST_F(ChildProcess, OutputAndErrorsMayGoToADescriptor) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ProcessOptions options;
    options.output_to = ends[1];
    EXPECT_EQ(run({"sh", "-c", "echo out; echo err >&2"}, options), 0);
    ::close(ends[1]);
    char text[16] = "";
    EXPECT_EQ(::read(ends[0], text, sizeof text - 1), 8);
    EXPECT_STREQ(text, "out\nerr\n");
    ::close(ends[0]);
}

TEST_F(ChildProcess, ReportsHowItEnded) {
    EXPECT_EQ(run({"sh", "-c", "exit 3"}, {}), 3);
    EXPECT_EQ(run({"sh", "-c", "kill -TERM $$"}, {}), 128 + SIGTERM);
}

TEST_F(ChildProcess, CanHaveItsOwnProcessGroup) {
    ProcessOptions options;
    for (const bool own : {false, true}) {
        options.own_group = own;
        const auto child = start_process({"sleep", "20"}, options);
        ASSERT_TRUE(child);
        EXPECT_EQ(::getpgid(*child), own ? *child : ::getpgrp());
        ::kill(*child, SIGKILL);
        EXPECT_EQ(wait_for_process(*child), 128 + SIGKILL);
    }
}

TEST_F(ChildProcess, WhatCannotBeStartedIsAnError) {
    const auto none = start_process({"no-such-program-of-weft"}, {});
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::kUnreadable);
    EXPECT_NE(none.error().sentence().find("no-such-program-of-weft"), std::string::npos);
    ProcessOptions options;
    options.folder = in("gone");
    EXPECT_FALSE(start_process({"true"}, options));
}

}  // namespace
}  // namespace weft
