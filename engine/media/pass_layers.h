#pragma once
// The layers of renderers' EXRs, and which of them holds a pass.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/image.h"

namespace weft {

/// The channels of one part of an EXR that share what is before the last dot of their names.
struct PassLayer {
    int part = 0;
    /// "shot.Vector" of "shot.Vector.X". For channels without a dot the name of their part, as a
    /// file with a part for each pass has it; empty if the part has none.
    std::string name;
    std::string part_name;
    bool prefixed = false;              ///< The channels' names begin with `name` and a dot.
    std::vector<std::string> channels;  ///< What follows the last dot: "X".
    std::string codec;                  ///< "zip", "dwaa:45": as OpenImageIO names it.
    std::string pass;        ///< `name` without a view: "shot.Depth" of "shot.Depth.left".
    std::string view;        ///< "left"; empty if neither the name nor the part tells one.
    bool first_view = true;  ///< Of the stereo file's first view, as layers without one are.

    /// The name of the channel in its part, of "R" also one that ends in "red", and so on; empty if
    /// the layer has none.
    [[nodiscard]] std::string channel(std::string_view last) const;
    [[nodiscard]] bool has(const std::vector<std::string>& all) const;
};

/// In the file's order; parts with deep samples are left out. Errors: Unreadable.
[[nodiscard]] Expected<std::vector<PassLayer>> list_pass_layers(const std::string& path);

/// "shot.Vector: X, Y, Z, W; Depth: Z", for messages.
[[nodiscard]] std::string list_of(const std::vector<PassLayer>& layers);

/// What a pass is called and made of.
struct PassKind {
    std::string what;                 ///< "motion", for messages.
    std::vector<std::string> layers;  ///< Layers that hold it, the likeliest first.
    /// Sets of channels of which the layer must have one, the likeliest first.
    std::vector<std::vector<std::string>> channels;
    std::string_view layer_setting;  ///< How a user names the layer; empty: cannot.
};

struct FoundPass {
    PassLayer layer;
    std::vector<std::string> channels;     ///< Full names, in the kind's order.
    std::vector<std::string> also_called;  ///< Other layers that might be meant.
    std::string why = {};  ///< Why it is this one of them: "which belongs to fg.Combined".
    enum class Told { kByNeighbour, kByView, kByOrder } told = Told::kByOrder;
};

/// The pass in this layer, whatever its name, if it has the channels.
[[nodiscard]] std::optional<FoundPass> pass_in(const PassLayer& layer, const PassKind& kind);

/// The pass of this kind, in the layer `named`, else in one of the kind's names, also behind
/// another name ("shot.Vector") and of any view. Of several, that which stands beside one of the
/// layers `beside` ("shot.Combined.left"), as the view layers and the views of one render do; else
/// the first, of the file's first view. Nothing if there is none.
[[nodiscard]] std::optional<FoundPass> find_pass(const std::vector<PassLayer>& layers,
                                                 const PassKind& kind, const std::string& named,
                                                 const std::vector<std::string>& beside = {});

/// The same of a file with one layer of at most four channels, whatever its name.
[[nodiscard]] std::optional<FoundPass> find_pass_alone(const std::vector<PassLayer>& layers,
                                                       const PassKind& kind);

/// The layer of this name, else of a part of this name, else the only one of this name behind
/// another, small and capital letters alike; null: none.
[[nodiscard]] const PassLayer* layer_named(const std::vector<PassLayer>& layers,
                                           std::string_view name);

/// Is the layer's last name, but for a view, `wanted`, small and capital letters alike?
[[nodiscard]] bool is_called(const PassLayer& layer, std::string_view wanted);

/// The samples of the pass' channels, each row by row at the display window. Errors: those of
/// reading; Unreadable if it is not half or float, or not of the size `expected` (empty: any).
[[nodiscard]] Expected<std::vector<std::vector<float>>> read_pass(const std::string& path,
                                                                  const PassKind& kind,
                                                                  const FoundPass& pass,
                                                                  Size expected, Size& size);

/// "it has no … pass", listing the layers.
[[nodiscard]] Error no_such_pass(const std::string& path, const PassKind& kind,
                                 const std::string& named, const std::vector<PassLayer>& layers);

/// A remedy for a pass of another size than the plate's.
inline constexpr const char* kRenderAlike = "render it at the plate's size";

}  // namespace weft
