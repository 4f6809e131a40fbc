// The editor's side of messages: settings by the labels of its panels, and no flag.
#include "ui/parameters/setting_labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/project/validate.h"

namespace weft::ui {
namespace {

using testing::HasSubstr;
using testing::Not;

class SettingLabels : public testing::Test {
  protected:
    void SetUp() override { set_setting_namer(setting_label); }
    void TearDown() override { set_setting_namer(nullptr); }
};

TEST_F(SettingLabels, NameSettingsAsThePanelsDo) {
    EXPECT_EQ(by({{setting::kReferenceFrame, "1012"}}), " (Reference frames: 1012)");
    EXPECT_EQ(by({{setting::kTemporalMode, "locked"}}), " (Temporal mode: Locked to the surface)");
    EXPECT_EQ(by({{setting::kFeather}, {setting::kOverlap}}), " (Feather, Overlap)");
    EXPECT_EQ(setting_name({"placement.scale"}), "Scale");
}

TEST_F(SettingLabels, LeaveOutWhatTheEditorDoesNotHave) {
    EXPECT_EQ(by({{setting::kOutputRoot, "/proj"}}), "");
    EXPECT_EQ(by({{setting::kRestart}, {setting::kOverwrite}}), " (If files exist: Overwrite)");
}

TEST_F(SettingLabels, HoldNoWordOfTheCommandLine) {
    for (const std::string_view key : setting::kAll) {
        const std::string label = setting_label({key});
        EXPECT_THAT(label, Not(HasSubstr("--")));
        EXPECT_THAT(label, Not(HasSubstr("weft ")));
    }
}

TEST_F(SettingLabels, AreInWhatAProjectLacks) {
    Project project;
    std::string all;
    for (const Issue& issue : validate(project))
        all += issue.text() + "\n";
    EXPECT_THAT(all, HasSubstr("Add one (Regions → +)"));
    Region region;
    region.id = 1;
    project.regions.emplace_back(region);
    for (const Issue& issue : validate(project))
        all += issue.text() + "\n";
    EXPECT_THAT(all, HasSubstr("No texture is set. Set a sample or a plane (Texture, Tile)"));
    EXPECT_THAT(all, Not(HasSubstr("--")));
}

}  // namespace
}  // namespace weft::ui
