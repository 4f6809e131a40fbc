// Messages of render jobs speak of the editor's labels, never of flags.
#include "app/base/job_messages.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/project/parameters.h"
#include "engine/core/setting.h"

namespace weft::test {
namespace {

std::string label(const SettingRef& setting) {
    if (setting.key == setting::kOverwrite) return "If files exist: Overwrite";
    if (setting.key == setting::kReferenceFrame) return "Reference frames: " + setting.value;
    return {};
}

class JobMessages : public ::testing::Test {
  protected:
    void SetUp() override { set_setting_namer(label); }
    void TearDown() override { set_setting_namer(nullptr); }
};

TEST_F(JobMessages, SettingsGetTheirLabels) {
    EXPECT_EQ(with_setting_names("0001.png exists already. Use {run.overwrite}, or another name."),
              "0001.png exists already. Use If files exist: Overwrite, or another name.");
    EXPECT_EQ(with_setting_names("Choose one ({reference_frames=1012})."),
              "Choose one (Reference frames: 1012).");
}

TEST_F(JobMessages, SettingsWithoutALabelAreLeftOut) {
    EXPECT_EQ(with_setting_names("Free memory ({run.memory})."), "Free memory.");
    EXPECT_EQ(with_setting_names("Do it ({run.memory}, {run.overwrite})."),
              "Do it (If files exist: Overwrite).");
}

// Whatever setting a message names, no key of it is left.
TEST_F(JobMessages, NoSettingStaysAKey) {
    std::vector<std::string> keys(setting::kAll.begin(), setting::kAll.end());
    for (const auto& entry : region_parameters())
        keys.push_back(entry.full_key());
    for (const auto& entry : project_parameters())
        keys.push_back(entry.full_key());
    EXPECT_GT(keys.size(), 200u);
    for (const std::string& key : keys) {
        const std::string said = with_setting_names("Do it ({" + key + "}), or ({" + key + "=1}).");
        EXPECT_EQ(said.find_first_of("{}"), std::string::npos) << said;
    }
}

TEST_F(JobMessages, OtherBracesStay) {
    EXPECT_EQ(with_setting_names("a {b} {c"), "a {b} {c");
}

}  // namespace
}  // namespace weft::test
