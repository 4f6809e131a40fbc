#pragma once
// What frames are made from, known by content: for a frame's header, and to tell whether a frame of
// an earlier run is still the one that would be rendered now.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "app/shot/shot.h"
#include "engine/pipeline/region_mattes.h"

namespace weft {

/// The kinds of input that are told apart.
enum class InputKind : std::uint8_t { kPlate, kMattes, kTexture, kMotion, kPasses, kColor };
inline constexpr std::size_t kInputKinds = 6;

/// Hashes of what each frame of a shot is made from, by kinds of input. A frame depends on the
/// frames between it and its reference frames, painted mattes and those on which light, grain,
/// blur, form and focus are measured (analysed_span()): on their plate, mattes and passes; and on
/// all painted mattes, tracks, textures and pictures. Names, folders, times and machines do not
/// count, nor do frames that are not needed. Immutable; thread-safe.
class InputHashes {
  public:
    /// Of these frames of the plate. Reads files as far as Shot::files does not know what they
    /// contain. Files that are missing or cannot be read are left out; the code that needs them
    /// reports the error.
    InputHashes(std::shared_ptr<const Shot> shot, const std::vector<int>& frames);

    /// "plate:0123456789abcdef,mattes:…": a hash of 16 hexadecimal digits for each kind of input
    /// that there is: plate, mattes, texture, motion, passes, color (the OpenColorIO config and its
    /// tables). The same on every machine, and for every part of the shot that is rendered.
    [[nodiscard]] std::string text(int frame) const;
    /// The same of several frames together.
    [[nodiscard]] std::string text(const std::vector<int>& frames) const;

  private:
    using Hashes = std::array<Hash128, kInputKinds>;
    // Numbered files: what each frame's contains.
    struct Entry {
        std::int64_t frame = 0;
        Hash128 contents;
    };
    struct Sequence {
        InputKind kind = InputKind::kPlate;
        std::vector<Entry> entries;  // ascending
    };
    struct OfRegion {
        Hashes fixed{};  // of what does not depend on the frame
        std::vector<Sequence> sequences;
    };

    [[nodiscard]] Hash128 contents_of(const std::string& path) const;
    // What a frame depends on, of each region and at the end of the plate.
    [[nodiscard]] std::vector<FrameSpan> spans_of(int frame) const;
    // The frames of the plate in a span.
    [[nodiscard]] std::vector<int> frames_in(const FrameSpan& span) const;
    void find_plate();
    void add_entries(const std::vector<int>& frames, const std::vector<std::string>& paths,
                     Sequence& to) const;
    void read_plate(const FrameSpan& span);
    void add_path(InputKind kind, const std::string& path, const FrameSpan& span, OfRegion& region);
    void add_region(const Region& region, const FrameSpan& span);
    void add_texture_and_color();
    [[nodiscard]] Hashes hashes(int frame) const;
    [[nodiscard]] std::string text_of(const Hashes& hashes) const;

    std::shared_ptr<const Shot> shot_;
    FrameSpan there_;  // from the first to the last frame of the plate that is there
    Sequence plate_;
    std::vector<OfRegion> regions_;
    Hashes whole_{};  // of what is one for the whole shot
    std::array<bool, kInputKinds> given_{};
};

/// What differs between two such texts, in words for a message: "the plate", "the mattes", …
[[nodiscard]] std::vector<std::string> changed_inputs(const std::string& had,
                                                      const std::string& wanted);

}  // namespace weft
