#pragma once
// A small shot on disk and jobs that render it in this process.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "app/render/render_job.h"
#include "tests/cli/card_scene.h"

namespace weft::test {

class ShotTest : public ::testing::Test {
  protected:
    static constexpr int kFrames = 6;
    void SetUp() override;
    void TearDown() override { std::filesystem::remove_all(folder_); }

    /// Draft quality, a ready plane, light from the plate, to the folder `out`.
    JobSpec spec(const std::string& out) const;
    /// A hash of every file of a folder, by name; hidden ones too.
    std::map<std::string, std::string> contents(const std::string& folder) const;
    /// Runs a job and counts the steps of its analysis.
    int analysed_steps(const JobSpec& job) const;
    std::string in(const std::string& name) const { return (folder_ / name).string(); }

    std::filesystem::path folder_;
};

}  // namespace weft::test
