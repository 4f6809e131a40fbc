#include "app/mattes/scribble_matte.h"

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "engine/mask/edge_alpha.h"
#include "engine/mask/signed_distance.h"
#include "engine/motion/view_mat.h"

namespace weft {
namespace {

// Longest sides: where the whole crop is cut, and where the edge found there is cut again.
constexpr int kCoarsePx = 192, kFinePx = 512;
constexpr int kBorder = 2;  // pixels at the border of a crop that may be certain

cv::Mat scaled(const cv::Mat& from, double scale) {
    cv::Mat out;
    const cv::Size size(std::max(8, static_cast<int>(from.cols * scale)),
                        std::max(8, static_cast<int>(from.rows * scale)));
    cv::resize(from, out, size, 0, 0, cv::INTER_AREA);
    return out;
}

// A crop of the picture, of the scribbles and of the matte before, full size.
struct Crop {
    cv::Mat colours, inside, outside, before;
    bool whole = false;    // it is the whole picture
    bool painted = false;  // the matte before is not empty
    // What looks like the surface at the picture's border goes on there, as walls and floors do.
    bool open = false;
};

// The longest side of a crop scaled to `px`, never enlarged.
double scale_to(const Crop& crop, int px) {
    return std::min(1.0, static_cast<double>(px) / std::max(crop.colours.cols, crop.colours.rows));
}

// A few mean colours of the pixels in `where`; none where there are no such pixels.
std::vector<cv::Vec3f> colours_of(const cv::Mat& colours, const cv::Mat& where) {
    std::vector<cv::Vec3f> all;
    for (int y = 0; y < colours.rows; ++y)
        for (int x = 0; x < colours.cols; ++x)
            if (where.at<std::uint8_t>(y, x) != 0) all.emplace_back(colours.at<cv::Vec3b>(y, x));
    constexpr std::size_t kMost = 4;
    if (all.size() <= kMost) return all;
    const cv::Mat samples(static_cast<int>(all.size()), 3, CV_32F, all.data());
    const cv::TermCriteria enough(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 10, 0.5);
    cv::Mat numbers, centres;
    cv::kmeans(samples, kMost, numbers, enough, 1, cv::KMEANS_PP_CENTERS, centres);
    std::vector<cv::Vec3f> out;
    out.reserve(kMost);
    for (int k = 0; k < centres.rows; ++k)
        out.emplace_back(centres.ptr<float>(k));
    return out;
}

double distance_to(const std::vector<cv::Vec3f>& centres, const cv::Vec3f& colour) {
    double least = std::numeric_limits<double>::max();
    for (const cv::Vec3f& centre : centres)
        least = std::min(least, cv::norm(colour - centre));
    return least;
}

// Where the picture has other colours than under the lines inside: by more than these vary
// themselves.
cv::Mat foreign_to(const cv::Mat& colours, const cv::Mat& inside) {
    constexpr double kLeast = 20, kTimes = 4;  // of 255; of the mean distance under the lines
    const std::vector<cv::Vec3f> own = colours_of(colours, inside);
    double sum = 0;
    int count = 0;
    cv::Mat distances(colours.size(), CV_32F), out;
    for (int y = 0; y < colours.rows; ++y)
        for (int x = 0; x < colours.cols; ++x) {
            const double distance = distance_to(own, colours.at<cv::Vec3b>(y, x));
            distances.at<float>(y, x) = static_cast<float>(distance);
            if (inside.at<std::uint8_t>(y, x) == 0) continue;
            sum += distance;
            ++count;
        }
    out = distances > std::max(kLeast, kTimes * sum / std::max(1, count));
    return out;
}

// What is certain: the scribbles, and at the border of the crop what lies beyond it. `labels` has
// the rest.
void add_certain(const Crop& crop, const cv::Mat& colours, cv::Mat& labels) {
    cv::Mat inside, outside, before;
    cv::resize(crop.inside, inside, labels.size(), 0, 0, cv::INTER_AREA);
    cv::resize(crop.outside, outside, labels.size(), 0, 0, cv::INTER_AREA);
    cv::resize(crop.before, before, labels.size(), 0, 0, cv::INTER_AREA);
    // Without outside scribbles, an unpainted border counts as outside.
    const bool closed = cv::countNonZero(outside > 127) == 0;
    if (closed || (crop.painted && !crop.whole)) {
        cv::Mat border(labels.size(), CV_8UC1, cv::Scalar(0));
        cv::rectangle(border, cv::Rect(0, 0, labels.cols, labels.rows), cv::Scalar(255), kBorder);
        if (crop.open) border &= foreign_to(colours, inside > 127);
        labels.setTo(cv::GC_BGD, border);
        if (!crop.whole) labels.setTo(cv::GC_FGD, border & (before > 127));
    }
    labels.setTo(cv::GC_BGD, outside > 127);
    labels.setTo(cv::GC_FGD, inside > 127);
}

// What is inside and hangs together with something that certainly is: other places of the same
// colours are not the surface.
cv::Mat inside_of(const cv::Mat& labels) {
    const cv::Mat all = (labels == cv::GC_FGD) | (labels == cv::GC_PR_FGD);
    cv::Mat pieces;
    const int count = cv::connectedComponents(all, pieces);
    std::vector<bool> certain(static_cast<std::size_t>(count), false);
    for (int y = 0; y < labels.rows; ++y)
        for (int x = 0; x < labels.cols; ++x)
            if (labels.at<std::uint8_t>(y, x) == cv::GC_FGD)
                certain[static_cast<std::size_t>(pieces.at<int>(y, x))] = true;
    cv::Mat out(labels.size(), CV_8UC1, cv::Scalar(0));
    for (int y = 0; y < labels.rows; ++y)
        for (int x = 0; x < labels.cols; ++x)
            if (all.at<std::uint8_t>(y, x) != 0 &&
                certain[static_cast<std::size_t>(pieces.at<int>(y, x))])
                out.at<std::uint8_t>(y, x) = 255;
    return out;
}

// What is not certain is at first on the side whose colours are nearer (Li, Sun, Tang, Shum: Lazy
// Snapping, 2004). Were all of it outside, the models would take a large surface for its ground.
void guess_the_rest(const cv::Mat& colours, cv::Mat& labels) {
    const auto inside = colours_of(colours, labels == cv::GC_FGD);
    const auto outside = colours_of(colours, labels == cv::GC_BGD);
    if (inside.empty() || outside.empty()) return;
    for (int y = 0; y < labels.rows; ++y)
        for (int x = 0; x < labels.cols; ++x) {
            std::uint8_t& label = labels.at<std::uint8_t>(y, x);
            const cv::Vec3f colour = colours.at<cv::Vec3b>(y, x);
            if (label == cv::GC_PR_BGD &&
                distance_to(inside, colour) < distance_to(outside, colour))
                label = cv::GC_PR_FGD;
        }
}

// The whole crop at a size at which a cut takes a moment.
cv::Mat coarse_cut(const Crop& crop, cv::Mat& background, cv::Mat& foreground) {
    const cv::Mat colours = scaled(crop.colours, scale_to(crop, kCoarsePx));
    cv::Mat labels(colours.size(), CV_8UC1, cv::Scalar(cv::GC_PR_BGD));
    add_certain(crop, colours, labels);
    guess_the_rest(colours, labels);
    cv::grabCut(colours, labels, {}, background, foreground, 3, cv::GC_INIT_WITH_MASK);
    return inside_of(labels);
}

// The same cut along the edge of `coarse` only, where the colours are finer.
cv::Mat fine_cut(const Crop& crop, const cv::Mat& coarse, cv::Mat& background,
                 cv::Mat& foreground) {
    const cv::Mat colours = scaled(crop.colours, scale_to(crop, kFinePx));
    cv::Mat found, inner, outer;
    cv::resize(coarse, found, colours.size(), 0, 0, cv::INTER_LINEAR);
    found = found > 127;
    const int reach = 2 * (colours.cols / std::max(1, coarse.cols)) + 3;
    const cv::Mat disc =
        cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1});
    cv::erode(found, inner, disc);
    cv::dilate(found, outer, disc);
    cv::Mat labels(colours.size(), CV_8UC1, cv::Scalar(cv::GC_PR_BGD));
    labels.setTo(cv::GC_PR_FGD, found);
    labels.setTo(cv::GC_FGD, inner);
    labels.setTo(cv::GC_BGD, outer == 0);
    add_certain(crop, colours, labels);
    const int inside = cv::countNonZero(inside_of(labels));
    if (inside == 0 || inside == static_cast<int>(labels.total())) return found;
    cv::grabCut(colours, labels, {}, background, foreground, 1, cv::GC_EVAL);
    return inside_of(labels);
}

// The picture's border ends nothing: what was taken for outside there goes on as what lies next to
// it. `box`: of the crop that was cut, in the picture.
cv::Mat continued_to_border(const cv::Mat& found, const cv::Rect& box, cv::Size picture) {
    const int left = box.x == 0 ? kBorder : 0, top = box.y == 0 ? kBorder : 0;
    const int right = box.br().x == picture.width ? kBorder : 0;
    const int bottom = box.br().y == picture.height ? kBorder : 0;
    const cv::Rect inner(left, top, found.cols - left - right, found.rows - top - bottom);
    cv::Mat out;
    // Isolated: what lies beside the part in its own matrix must not be taken instead.
    cv::copyMakeBorder(found(inner), out, top, bottom, left, right,
                       cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
    return out;
}

// Whether it goes on beyond the crop, as far as one can tell: its outermost pixels may be certain.
bool reaches_border(const cv::Mat& found) {
    cv::Mat border(found.size(), CV_8UC1, cv::Scalar(0));
    cv::rectangle(border, cv::Rect(0, 0, found.cols, found.rows), cv::Scalar(255), 2 * kBorder + 1);
    return cv::countNonZero(found & border) > 0;
}

// The share of the outline that lies on edges of the picture; its borders count as such.
double share_on_edges(const cv::Mat& found, const cv::Mat& colours) {
    constexpr double kEdge = 12;  // of 255, between two pixels beside the outline
    int outline = 0, on_edges = 0;
    const auto look = [&](int x, int y, int dx, int dy) {
        if (found.at<std::uint8_t>(y, x) == found.at<std::uint8_t>(y + dy, x + dx)) return;
        ++outline;
        const int x0 = std::max(0, x - dx), y0 = std::max(0, y - dy);
        const int x1 = std::min(found.cols - 1, x + 2 * dx);
        const int y1 = std::min(found.rows - 1, y + 2 * dy);
        const cv::Vec3f a = colours.at<cv::Vec3b>(y0, x0), b = colours.at<cv::Vec3b>(y1, x1);
        on_edges += cv::norm(a - b, cv::NORM_INF) > kEdge;
    };
    for (int y = 0; y + 1 < found.rows; ++y)
        for (int x = 0; x + 1 < found.cols; ++x) {
            look(x, y, 1, 0);
            look(x, y, 0, 1);
        }
    return outline == 0 ? 1 : static_cast<double>(on_edges) / outline;
}

// How far lines act where the picture does not show that the surface goes further, px.
int reach_of(const cv::Mat& keep) {
    constexpr int kLeast_px = 24, kOfPicture = 32;
    const cv::Rect box = cv::boundingRect(keep > 127);
    return std::max({kLeast_px, std::max(keep.cols, keep.rows) / kOfPicture,
                     std::max(box.width, box.height) / 2});
}

// With the edge that the same outline gets on the frames to which it is propagated.
cv::Mat with_edge(const cv::Mat& colours, const cv::Mat& found) {
    constexpr float kWidth_px = 1.5f;  // as boundary_refiner.cpp
    const Size size{found.cols, found.rows};
    ImageU8x3 picture(size.width, size.height);
    Matte shape(size);
    for (int y = 0; y < size.height; ++y) {
        std::copy_n(colours.ptr<std::uint8_t>(y), 3 * size.width, picture.pixel(0, y));
        for (int x = 0; x < size.width; ++x)
            shape.at(x, y) = found.at<std::uint8_t>(y, x) > 127;
    }
    constexpr float kLimit_px = 8;
    constexpr int kPasses = 2;  // a binary label's staircase becomes a line
    const ImageF1 phi = smooth_distance(signed_distance(shape, kLimit_px), kPasses);
    return as_mat(edge_alpha(picture, phi, kWidth_px)).clone();
}

// 255 within reach of the lines, falling to 0 over two pixels.
cv::Mat within_reach(const cv::Mat& keep) {
    cv::Mat distance, out;
    cv::distanceTransform(keep <= 127, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    const double reach = reach_of(keep);
    distance.convertTo(out, CV_8UC1, -127.5, 127.5 * (reach + 1));
    return out;
}

cv::Rect box_around(const cv::Mat& marks) {
    cv::Rect box = cv::boundingRect(marks);
    const int margin = std::max(box.width, box.height) / 2 + 16;
    box = cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin);
    return box & cv::Rect({}, marks.size());
}

constexpr double kEnclosed = 0.75;  // the share of an outline on edges that ends a surface

cv::Mat pixels_of(ViewU8x3 picture) {
    return cv::Mat(picture.height(), picture.width(), CV_8UC3,
                   const_cast<std::uint8_t*>(picture.data()),
                   static_cast<std::size_t>(picture.stride()));
}

struct Cut {
    cv::Mat coarse, fine;
    double on_edges = 0;         // the share of its outline that lies on edges of the picture
    bool is_enclosed = false;    // by such edges
    bool is_lines_only = false;  // nothing beside the lines inside, which end at no edge
};

Cut cut_out(const Crop& crop, const cv::Rect& box, cv::Size picture) {
    Cut out;
    cv::Mat background, foreground;
    // grabCut's k-means is random: a fixed seed gives equal mattes for equal scribbles
    cv::setRNGSeed(1);
    out.coarse = coarse_cut(crop, background, foreground);
    out.fine =
        continued_to_border(fine_cut(crop, out.coarse, background, foreground), box, picture);
    out.on_edges = share_on_edges(out.fine, scaled(crop.colours, scale_to(crop, kFinePx)));
    out.is_enclosed = out.on_edges >= kEnclosed;
    cv::Mat lines;
    cv::resize(crop.inside, lines, out.coarse.size(), 0, 0, cv::INTER_AREA);
    constexpr double kLittle = 1.25;
    out.is_lines_only =
        !out.is_enclosed && cv::countNonZero(out.coarse) <= kLittle * cv::countNonZero(lines > 127);
    return out;
}

}  // namespace

Matte segment_scribbles(const Matte& before, ViewU8x3 picture, const Matte& keep,
                        const Matte& drop) {
    if (cv::countNonZero(as_mat(keep) > 127) == 0) return before;
    const cv::Mat all = pixels_of(picture);
    const cv::Rect everything(0, 0, before.width(), before.height());
    cv::Rect box = box_around(cv::max(as_mat(keep), as_mat(drop)));
    const bool painted = cv::countNonZero(as_mat(before) > 127) > 0;
    const auto crop_of = [&](bool open) {
        return Crop{all(box),
                    as_mat(keep)(box),
                    as_mat(drop)(box),
                    as_mat(before)(box),
                    box == everything,
                    painted,
                    open};
    };
    Cut cut = cut_out(crop_of(false), box, everything.size());
    if (!painted && box != everything && (reaches_border(cut.coarse) || cut.is_lines_only)) {
        box = everything;
        cut = cut_out(crop_of(false), box, everything.size());
    }
    // All of a plain surface that ends at the picture's border counts as outside.
    if (!painted && cut.is_lines_only) {
        cut = cut_out(crop_of(true), box, everything.size());
    } else if (!painted && box == everything && reaches_border(cut.coarse)) {
        // A table lost its corners to it; what follows the picture's edges better is right.
        Cut open = cut_out(crop_of(true), box, everything.size());
        if (open.on_edges > cut.on_edges) cut = std::move(open);
    }
    // Without a line outside only the picture can say how far the surface goes: by its edges.
    const bool told = cv::countNonZero(as_mat(drop)(box) > 127) > 0 || cut.is_enclosed;
    const Crop crop = crop_of(false);
    cv::Mat full;
    cv::resize(cut.fine, full, box.size(), 0, 0, cv::INTER_CUBIC);
    full = with_edge(crop.colours, full);
    if (!told) {
        const cv::Mat near = within_reach(crop.inside);
        cv::min(full, near, full);
        cv::max(full, cv::min(crop.before, 255 - near), full);
    }
    Matte out = before;
    for (int y = 0; y < box.height; ++y)
        std::copy_n(full.ptr<std::uint8_t>(y), box.width, out.pixel(box.x, box.y + y));
    return out;
}

bool ends_at_edges(const Matte& matte, ViewU8x3 picture) {
    const cv::Mat inside = as_mat(matte) > 127;
    if (cv::countNonZero(inside) == 0) return false;
    const cv::Mat all = pixels_of(picture);
    const double scale = std::min(1.0, static_cast<double>(kFinePx) / std::max(all.cols, all.rows));
    return share_on_edges(scaled(inside, scale) > 127, scaled(all, scale)) >= kEnclosed;
}

}  // namespace weft
