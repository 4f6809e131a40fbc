#include "texture_db/starter/starter.h"

#include <algorithm>
#include <cstdlib>

#include "texture_db/starter/families.h"

namespace weft {
namespace {

struct FamilyEntry {
    std::string_view name;
    std::string_view material;
    starter::Family make;
    int count;
};

// More variants for materials of which few photographs exist.
constexpr FamilyEntry kFamilies[]{
    {"weave", "fabric", starter::weave, 240},
    {"knit", "knit", starter::knit, 190},
    {"leather", "leather", starter::leather, 190},
    {"fur", "fur", starter::fur, 180},
    {"straw", "straw", starter::straw, 130},
    {"ceramic", "ceramic", starter::ceramic, 120},
    {"cobblestone", "cobblestone", starter::cobblestone, 130},
    {"plaster", "plaster", starter::plaster, 130},
    {"paper", "paper", starter::paper, 120},
    {"gravel", "gravel", starter::gravel, 130},
    {"scales", "skin", starter::scales, 120},
    {"wallpaper", "wallpaper", starter::wallpaper, 120},
    {"rubber", "rubber", starter::rubber, 110},
    {"snow", "snow", starter::snow, 110},
    {"water", "water", starter::water, 110},
    {"marble", "marble", starter::marble, 110},
    {"foliage", "foliage", starter::foliage, 110},
    {"carpet", "carpet", starter::carpet, 110},
    {"wood", "wood", starter::wood, 110},
    {"bark", "bark", starter::bark, 110},
    {"brick", "brick", starter::brick, 110},
    {"tiles", "tiles", starter::tiles, 110},
    {"stone", "stone", starter::stone, 110},
    {"roof", "roof", starter::roof, 110},
    {"concrete", "concrete", starter::concrete, 110},
    {"asphalt", "asphalt", starter::asphalt, 110},
    {"dirt", "dirt", starter::dirt, 110},
    {"sand", "sand", starter::sand, 110},
    {"grass", "grass", starter::grass, 110},
    {"lava", "lava", starter::lava, 110},
    {"metal", "metal", starter::metal, 110},
    {"rust", "rust", starter::rust, 110},
};

const FamilyEntry* find_family(std::string_view name) {
    for (const FamilyEntry& entry : kFamilies) {
        if (entry.name == name) return &entry;
    }
    return nullptr;
}

constexpr int kOriginalSide_px = 384;

}  // namespace

const std::vector<StarterItem>& starter_catalogue() {
    static const std::vector<StarterItem> kItems = [] {
        std::vector<StarterItem> items;
        for (const FamilyEntry& entry : kFamilies) {
            for (int n = 0; n < entry.count; ++n)
                items.push_back({entry.name, n, entry.material});
        }
        return items;
    }();
    return kItems;
}

StarterPicture make_starter(const StarterItem& item, int side_px) {
    const FamilyEntry* family = find_family(item.family);
    const auto index = static_cast<std::uint64_t>(family - kFamilies);
    starter::Dice dice(index, static_cast<std::uint64_t>(item.number));
    starter::Relief relief(side_px);
    starter::Label label;
    label.light.azimuth_deg = dice.uniform(95, 160);
    label.light.elevation_deg = dice.uniform(36, 52);
    family->make(dice, relief, label);
    StarterPicture out;
    out.pixels = relief.photograph(label.light, dice.seed());
    out.name = label.name + " " + std::to_string(item.number + 1);
    out.tags = std::move(label.tags);
    out.unit = label.unit;
    out.tags.emplace_back("procedural");
    return out;
}

std::string starter_source(const StarterItem& item) {
    return std::string(item.family) + "/" + std::to_string(item.number);
}

Expected<ImageU8x3> starter_original(const std::string& source) {
    const auto slash = source.find('/');
    const FamilyEntry* family = find_family(std::string_view(source).substr(0, slash));
    const int number = slash == std::string::npos ? -1 : std::atoi(source.c_str() + slash + 1);
    if (!family || number < 0 || number >= family->count) {
        return fail(ErrorCode::kUnreadable,
                    "This version of weft has no starter texture '" + source + "'.");
    }
    return make_starter({family->name, number, family->material}, kOriginalSide_px).pixels;
}

}  // namespace weft
