#pragma once
// A plate whose latest frames stay decoded, so that analysis, preview and rendering do not decode
// the same frame twice.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/media/frame_reader.h"

namespace weft {

/// Keeps frames up to a budget and drops the least recently used first. Thread-safe: a frame that
/// several threads request is decoded once, different frames in parallel. A frame whose stamp() has
/// changed is decoded again. Errors are not kept.
class CachedReader final : public FrameReader {
  public:
    CachedReader(std::shared_ptr<const FrameReader> reader, std::size_t budget_bytes);
    ~CachedReader() override;

    /// The frame without a copy; it stays valid after the cache has dropped it. Errors as read().
    [[nodiscard]] Expected<std::shared_ptr<const PlateFrame>> read_shared(int frame) const;
    /// Memory of the kept frames, never more than the budget.
    [[nodiscard]] std::size_t size_bytes() const;

    [[nodiscard]] const std::vector<int>& frames() const override { return reader_->frames(); }
    [[nodiscard]] Size size() const override { return reader_->size(); }
    [[nodiscard]] double fps() const override { return reader_->fps(); }
    [[nodiscard]] PixelDepth depth() const override { return reader_->depth(); }
    [[nodiscard]] bool display_encoded() const override { return reader_->display_encoded(); }
    [[nodiscard]] FileColor color() const override { return reader_->color(); }
    [[nodiscard]] std::string path_of(int frame) const override { return reader_->path_of(frame); }
    [[nodiscard]] Expected<PlateFrame> read(int frame) const override;
    [[nodiscard]] Expected<Hash128> stamp(int frame) const override {
        return reader_->stamp(frame);
    }
    [[nodiscard]] std::vector<std::string> warnings() const override { return reader_->warnings(); }
    [[nodiscard]] double pixel_aspect() const override { return reader_->pixel_aspect(); }
    [[nodiscard]] int shown_frame(int frame) const override { return reader_->shown_frame(frame); }

  private:
    struct State;
    std::shared_ptr<const FrameReader> reader_;
    std::unique_ptr<State> state_;
};

/// A frame takes width · height · 12 bytes (16 with alpha): 4.9 MB at 854×480.
[[nodiscard]] std::shared_ptr<const CachedReader> cached(std::shared_ptr<const FrameReader> reader,
                                                         std::size_t budget_bytes);

}  // namespace weft
