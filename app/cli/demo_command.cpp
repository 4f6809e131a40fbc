#include <filesystem>

#include "app/cli/commands.h"
#include "app/project/codec/project_file.h"
#include "engine/media/frame_writer.h"
#include "engine/media/image_files.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// Writes plate frames above the same result frames, at half size, as one image.
Status write_contact_sheet(const Project& project, const std::string& path, const WriteRule& rule) {
    WEFT_TRY(plate, open_plate(project.plate.path, {}));
    WEFT_TRY(result, open_plate(project.output.path, {}));
    constexpr int kColumns = 4, kGap = 8;
    const Size half{plate->size().width / 2, plate->size().height / 2};
    ImageF3 sheet(kColumns * (half.width + kGap) - kGap, 2 * half.height + kGap, 0.12f);
    const auto& frames = result->frames();
    for (int column = 0; column < kColumns; ++column) {
        const std::size_t last = frames.size() - 1;
        const int frame = frames[last * static_cast<std::size_t>(column) / (kColumns - 1)];
        for (int row = 0; row < 2; ++row) {
            WEFT_TRY(picture, (row == 0 ? plate : result)->read(frame));
            for (int y = 0; y < half.height; ++y) {
                for (int x = 0; x < half.width; ++x) {
                    float* out = sheet.pixel(column * (half.width + kGap) + x,
                                             row * (half.height + kGap) + y);
                    for (int c = 0; c < 3; ++c) {
                        out[c] = 0.25f * (picture.rgb.pixel(2 * x, 2 * y)[c] +
                                          picture.rgb.pixel(2 * x + 1, 2 * y)[c] +
                                          picture.rgb.pixel(2 * x, 2 * y + 1)[c] +
                                          picture.rgb.pixel(2 * x + 1, 2 * y + 1)[c]);
                    }
                }
            }
        }
    }
    WriteOptions write;
    write.rule = rule;
    return write_image(path, sheet, {}, write);
}

}  // namespace

CommandResult demo_command(const std::string& assets, const std::string& given_output,
                           const RunOptions& run) {
    const std::string output = given_output.empty() ? "weft-demo" : given_output;
    const std::string path = (fs::path(assets) / "demo" / "demo.weft").string();
    WEFT_TRY(written, load_project(path));
    Project project = resolve_paths(written, project_dir(path));
    project.output.path = (fs::path(output) / "####.png").string();
    project.output.movie = (fs::path(output) / "demo.mp4").string();
    // The default folder belongs to the demo: a second run replaces the first.
    RunOptions demo_run = run;
    if (given_output.empty()) demo_run.overwrite = !run.skip_existing;
    const std::string sheet = (fs::path(output) / "contact_sheet.png").string();
    const bool goes_on = demo_run.overwrite || demo_run.skip_existing || demo_run.resume;
    WEFT_TRY(rule, write_rule({goes_on, run.output_root}, {path}, project));
    WEFT_TRY(answer, render_command(project, demo_run));
    if (run.dry_run) return answer;
    WEFT_CHECK_OK(write_contact_sheet(project, sheet, rule));
    answer.json["contact_sheet"] = absolute_path(sheet);
    answer.text += "The demo shot is in " + absolute_path(output) + ":\n  frames         " +
                   project.output.path + "\n  movie          " + project.output.movie +
                   "\n  contact sheet  " + sheet + " (plate above, result below)\n";
    return answer;
}

}  // namespace weft
