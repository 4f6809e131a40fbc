#include "bench/study/study_pictures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "engine/metrics/region.h"
#include "engine/metrics/tde.h"
#include "engine/pipeline/plate_views.h"
#include "engine/pipeline/sweep.h"

namespace weft {
namespace {

constexpr Size kWindow{220, 150};  // of a worst step, at 100 %
constexpr int kStripWidth = 300;
constexpr int kRim = 12;
constexpr double kGain = 4;

cv::Mat display_codes(ViewF3 encoded) {
    cv::Mat out(encoded.height(), encoded.width(), CV_8UC3);
    for (int y = 0; y < encoded.height(); ++y) {
        std::uint8_t* row = out.ptr(y);
        for (int x = 0; x < encoded.width(); ++x) {
            for (int c = 0; c < 3; ++c) {
                const float v = std::clamp(encoded.at(x, y, c), 0.0f, 1.0f);
                row[3 * x + 2 - c] = static_cast<std::uint8_t>(255.0f * v + 0.5f);
            }
        }
    }
    return out;
}

cv::Mat grey(ViewF1 luma, double gain) {
    cv::Mat out(luma.height(), luma.width(), CV_8UC1);
    for (int y = 0; y < luma.height(); ++y) {
        for (int x = 0; x < luma.width(); ++x) {
            const double v = gain * static_cast<double>(luma.at(x, y));
            out.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(std::clamp(v, 0.0, 255.0));
        }
    }
    return out;
}

cv::Mat cut(const cv::Mat& picture, const Recti& r) {
    return picture(cv::Rect(r.x0, r.y0, r.width(), r.height()));
}

// To the width of the strip.
cv::Mat shrunk(const cv::Mat& part) {
    if (part.cols <= kStripWidth) return part;
    cv::Mat smaller;
    const int height = std::max(1, part.rows * kStripWidth / part.cols);
    cv::resize(part, smaller, cv::Size(kStripWidth, height), 0, 0, cv::INTER_AREA);
    return smaller;
}

StudyPicture encoded(const cv::Mat& picture, std::string caption, int quality) {
    StudyPicture out;
    out.caption = std::move(caption);
    out.size = {picture.cols, picture.rows};
    cv::imencode(".jpg", picture, out.jpeg, {cv::IMWRITE_JPEG_QUALITY, quality});
    return out;
}

// The window of this size with the largest sum of the error; on a tie the first in scanline order.
Recti worst_window(const ImageF1& error) {
    const Size size{std::min(kWindow.width, error.width()),
                    std::min(kWindow.height, error.height())};
    cv::Mat values(error.height(), error.width(), CV_32FC1, const_cast<float*>(error.data()));
    cv::Mat sums;
    cv::integral(values, sums, CV_64F);
    Recti best{0, 0, size.width, size.height};
    double largest = -1;
    for (int y = 0; y + size.height <= error.height(); y += 4) {
        for (int x = 0; x + size.width <= error.width(); x += 4) {
            const double sum = sums.at<double>(y + size.height, x + size.width) -
                               sums.at<double>(y, x + size.width) -
                               sums.at<double>(y + size.height, x) + sums.at<double>(y, x);
            if (sum <= largest) continue;
            largest = sum;
            best = {x, y, x + size.width, y + size.height};
        }
    }
    return best;
}

class Illustrator {
  public:
    Illustrator(StudyResult& study, const CancelToken& cancel) : study_(study), cancel_(cancel) {}

    Status run() {
        OpenShotOptions open;
        open.textures = false;
        WEFT_TRY(shot, open_shot(study_.project, open));
        shot_ = shot;
        for (const StudyRun& run : study_.runs) {
            Project project = study_.project;
            project.color.out_space.clear();
            WEFT_TRY(reader, ResultReader::open(run.pattern, project));
            readers_.emplace(run.id, std::move(reader));
        }
        WEFT_CHECK_OK(add_strip());
        if (!strip_box_.empty()) WEFT_CHECK_OK(add_light());
        for (const StudyRun& run : study_.runs) {
            if (cancel_.cancelled()) return cancelled(cancel_);
            if (run.role != StudyRole::kAblation && run.role != StudyRole::kLight)
                WEFT_CHECK_OK(add_worst(run));
        }
        return {};
    }

  private:
    Expected<cv::Mat> plate(int frame) {
        WEFT_TRY(pixels, shot_->source->plate(frame));
        return display_codes(transformed(*pixels, *shot_->plan.display_from_plate));
    }

    Expected<cv::Mat> result(const StudyRun& run, int frame) {
        WEFT_TRY(pixels, readers_.at(run.id).read(frame));
        return display_codes(pixels.display);
    }

    Status add_strip() {
        const int count = static_cast<int>(study_.frames.size());
        for (const int ordinal : {1, 10, 20, 40}) {
            if (ordinal <= count)
                study_.strip_frames.push_back(study_.frames[static_cast<std::size_t>(ordinal - 1)]);
        }
        if (study_.strip_frames.back() != study_.frames.back() && study_.strip_frames.size() < 4)
            study_.strip_frames.push_back(study_.frames.back());
        Recti box;
        for (const int frame : study_.strip_frames) {
            WEFT_TRY(matte, visible_matte(*shot_, frame));
            box = box.united(matte_bounds(matte));
        }
        box = box.grown(kRim).intersected(rect_of(study_.size));
        strip_box_ = box;
        if (box.empty()) return {};
        WEFT_CHECK_OK(add_row("Source", box, [&](int frame) { return plate(frame); }));
        for (const StudyRun& run : study_.runs) {
            WEFT_CHECK_OK(add_row(run.title, box, [&](int frame) { return result(run, frame); }));
        }
        return {};
    }

    template <class Read>
    Status add_row(const std::string& title, const Recti& box, Read&& read) {
        StripRow row{title, {}};
        for (const int frame : study_.strip_frames) {
            WEFT_TRY(picture, read(frame));
            row.pictures.push_back(
                encoded(shrunk(cut(picture, box)), "frame " + std::to_string(frame), 82));
        }
        study_.strip.push_back(std::move(row));
        return {};
    }

    // Φ and the remaining reflectance, of the plate and of the lit result.
    Status add_light() {
        const StudyRun* full = study_.find("full");
        if (full == nullptr) return {};
        std::vector<std::string> warnings;
        AnalysisCacheOptions cache;
        cache.keep = false;
        WEFT_TRY(meter,
                 LightMeter::open(study_.project, study_.strip_frames, cache, cancel_, warnings));
        const std::map<std::string, std::string> titles{
            {"before", "Plate"},
            {"before_shading", "Its shading Φ"},
            {"before_reflectance", "Its reflectance"},
            {"after", "Result"},
            {"after_shading", "Shading seen in it"},
            {"after_reflectance", "Reflectance seen in it"},
            {"true_shading", "True shading"},
            {"true_reflectance", "True reflectance"},
            {"shading_difference", "Φ less the true shading, × 4"}};
        for (const int frame : study_.strip_frames) {
            WEFT_TRY(result, readers_.at(full->id).read(frame));
            WEFT_TRY(pictures, meter->pictures(frame, result.display));
            for (const auto& [name, picture] : pictures) {
                const std::string& title = titles.at(name);
                auto row = std::find_if(study_.light_strip.begin(), study_.light_strip.end(),
                                        [&](const StripRow& r) { return r.title == title; });
                if (row == study_.light_strip.end()) {
                    study_.light_strip.push_back({title, {}});
                    row = study_.light_strip.end() - 1;
                }
                row->pictures.push_back(encoded(shrunk(cut(display_codes(picture), strip_box_)),
                                                "frame " + std::to_string(frame), 82));
            }
        }
        return {};
    }

    // The motion of the step that was used for measuring: given, or estimated again from the
    // plates.
    Expected<FlowField> motion(int earlier, int later) {
        const auto known = motion_.find(later);
        if (known != motion_.end()) return known->second;
        FlowField field;
        if (shot_->plan.regions.front().true_motion) {
            WEFT_TRY(given, true_motion_between(*shot_, earlier, later));
            field = std::move(given);
        } else {
            WEFT_TRY(a, luma_of_plate(earlier));
            WEFT_TRY(b, luma_of_plate(later));
            WEFT_TRY(matte_a, visible_matte(*shot_, earlier));
            WEFT_TRY(matte_b, visible_matte(*shot_, later));
            field = measuring_motion(a, b, matte_a, matte_b);
        }
        motion_[later] = field;
        return field;
    }

    Expected<ImageF1> luma_of_plate(int frame) {
        WEFT_TRY(pixels, shot_->source->plate(frame));
        return luma_8bit(transformed(*pixels, *shot_->plan.display_from_plate));
    }

    Status add_worst(const StudyRun& run) {
        const FrameMeasures* worst = nullptr;
        for (const FrameMeasures& f : run.measured.frames) {
            if (f.tde && (worst == nullptr || *f.tde > *worst->tde)) worst = &f;
        }
        if (worst == nullptr) return {};
        const int later = worst->frame, earlier = later - 1;
        WEFT_TRY(field, motion(earlier, later));
        const bool forward =
            !shot_->plan.regions.front().true_motion || shot_->plan.regions.front().motion_forward;
        // The step is shown on the pixels of the frame that the motion lies on.
        const int here = forward ? earlier : later, there = forward ? later : earlier;
        WEFT_TRY(matte_here, visible_matte(*shot_, here));
        WEFT_TRY(matte_there, visible_matte(*shot_, there));
        const Matte visible = visible_in_both(field, matte_here, matte_there);
        WEFT_TRY(mine, readers_.at(run.id).read(here));
        WEFT_TRY(other, readers_.at(run.id).read(there));
        const ImageF1 luma = luma_8bit(mine.display),
                      after = moved(luma_8bit(other.display), field);
        ImageF1 error(luma.size());
        for (int y = 0; y < luma.height(); ++y) {
            for (int x = 0; x < luma.width(); ++x) {
                if (visible.at(x, y) == 0) continue;
                error.at(x, y) = std::abs(luma.at(x, y) - after.at(x, y));
            }
        }
        const Recti window = worst_window(error);
        WorstStep step{run.title, later, *worst->tde, {}};
        step.pictures.push_back(
            encoded(cut(display_codes(mine.display), window), "frame " + std::to_string(here), 88));
        step.pictures.push_back(encoded(cut(grey(after, 1), window),
                                        "frame " + std::to_string(there) + ", moved onto it", 88));
        step.pictures.push_back(encoded(cut(grey(error, kGain), window), "difference × 4", 88));
        study_.worst.push_back(std::move(step));
        return {};
    }

    StudyResult& study_;
    CancelToken cancel_;
    std::shared_ptr<const Shot> shot_;
    std::map<std::string, ResultReader> readers_;
    std::map<int, FlowField> motion_;
    Recti strip_box_;
};

}  // namespace

Status add_study_pictures(StudyResult& study, const CancelToken& cancel) {
    return Illustrator(study, cancel).run();
}

std::string data_uri(const std::vector<std::uint8_t>& jpeg) {
    static constexpr char kDigits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out = "data:image/jpeg;base64,";
    out.reserve(out.size() + jpeg.size() * 4 / 3 + 4);
    for (std::size_t k = 0; k < jpeg.size(); k += 3) {
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < 3; ++i)
            bits = bits << 8 | (k + i < jpeg.size() ? jpeg[k + i] : 0u);
        for (std::size_t i = 0; i < 4; ++i) {
            const bool there = k + i <= jpeg.size();
            out += there ? kDigits[bits >> (18 - 6 * i) & 63] : '=';
        }
    }
    return out;
}

}  // namespace weft
