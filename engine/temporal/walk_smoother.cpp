#include "engine/temporal/walk_smoother.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft {
namespace {

constexpr float kDecay = 0.4f;  // from one frame to the next; chosen on walls, floors and coats

float weight_of(int frames_off) {
    return std::pow(kDecay, static_cast<float>(std::abs(frames_off)));
}

void accumulate(LatticeField& sum, const LatticeField& field, float weight) {
    for (int j = 0; j < sum.nodes().height(); ++j) {
        for (int i = 0; i < sum.nodes().width(); ++i)
            sum.set_node(i, j, sum.node(i, j) + weight * field.node(i, j));
    }
}

}  // namespace

void WalkSmoother::place(const LatticeField& ref_from_cur) {
    if (!run_.empty() && run_.back().number == number_) run_.back().stays = true;
    finish();
    begin(ref_from_cur);
}

void WalkSmoother::begin(const LatticeField& ref_from_cur) {
    run_.clear();
    settled_ = 1;
    Frame& frame = run_.emplace_back();
    frame.number = number_;
    frame.ref_from_frame = ref_from_cur;
    frame.stays = true;
}

void WalkSmoother::add(const LatticeField& ref_from_cur, const LatticeField& prev_from_cur) {
    ++number_;
    Frame frame;
    frame.number = number_;
    frame.ref_from_frame = ref_from_cur;
    frame.prev_from_frame = prev_from_cur;
    frame.frame_from_prev = inverse(prev_from_cur);
    run_.push_back(std::move(frame));
    if (run_.size() > static_cast<std::size_t>(kReach)) settle(run_.size() - kReach);
    while (settled_ > static_cast<std::size_t>(kReach)) {
        run_.pop_front();
        --settled_;
    }
}

void WalkSmoother::skip() {
    finish();
    run_.clear();
    settled_ = 0;
    ++number_;
}

void WalkSmoother::hold() {
    if (!run_.empty()) run_.back().stays = true;
    skip();
}

std::vector<Settled> WalkSmoother::take() {
    for (Settled& frame : out_)
        frame.frames_back = number_ - frame.frames_back;
    return std::exchange(out_, {});
}

// A line over the frames around, weighted, at the frame.
LatticeField WalkSmoother::smoothed(std::size_t k) const {
    std::vector<std::pair<int, LatticeField>> said{{0, run_[k].ref_from_frame}};
    LatticeField there = run_[k].prev_from_frame;
    for (std::size_t s = k; s > 0 && k - s < kReach;) {
        --s;
        said.emplace_back(static_cast<int>(s) - static_cast<int>(k),
                          compose(there, run_[s].ref_from_frame));
        if (run_[s].stays) break;
        there = compose(there, run_[s].prev_from_frame);
    }
    there = {};
    for (std::size_t s = k + 1; s < run_.size() && s - k <= kReach; ++s) {
        there = there.empty() ? run_[s].frame_from_prev : compose(there, run_[s].frame_from_prev);
        said.emplace_back(static_cast<int>(s - k), compose(there, run_[s].ref_from_frame));
    }
    float m0 = 0, m1 = 0, m2 = 0;
    for (const auto& [off, field] : said) {
        const float w = weight_of(off);
        const auto t = static_cast<float>(off);
        m0 += w, m1 += w * t, m2 += w * t * t;
    }
    const float determinant = m0 * m2 - m1 * m1;
    constexpr std::size_t kFewest = 3;  // two frames determine any line
    if (said.size() < kFewest) return run_[k].ref_from_frame;
    LatticeField sum(run_[k].ref_from_frame.full_size(), run_[k].ref_from_frame.spacing());
    for (const auto& [off, field] : said)
        accumulate(sum, field, weight_of(off) * (m2 - static_cast<float>(off) * m1) / determinant);
    return sum;
}

void WalkSmoother::settle(std::size_t before) {
    for (; settled_ < before; ++settled_) {
        if (!run_[settled_].stays) out_.push_back({run_[settled_].number, smoothed(settled_)});
    }
}

}  // namespace weft
