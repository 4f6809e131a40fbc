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

// What photographs hardly give is made most of.
constexpr FamilyEntry kFamilies[]{
    {"weave", "fabric", starter::weave, 160},
    {"knit", "knit", starter::knit, 130},
    {"leather", "leather", starter::leather, 130},
    {"fur", "fur", starter::fur, 130},
    {"straw", "straw", starter::straw, 100},
    {"ceramic", "ceramic", starter::ceramic, 100},
    {"cobblestone", "cobblestone", starter::cobblestone, 100},
    {"plaster", "plaster", starter::plaster, 100},
    {"paper", "paper", starter::paper, 100},
    {"gravel", "gravel", starter::gravel, 100},
    {"scales", "skin", starter::scales, 100},
    {"wallpaper", "wallpaper", starter::wallpaper, 100},
    {"rubber", "rubber", starter::rubber, 80},
    {"snow", "snow", starter::snow, 70},
    {"water", "water", starter::water, 70},
    {"marble", "marble", starter::marble, 70},
    {"foliage", "foliage", starter::foliage, 60},
    {"carpet", "carpet", starter::carpet, 60},
    {"wood", "wood", starter::wood, 60},
    {"bark", "bark", starter::bark, 60},
    {"brick", "brick", starter::brick, 60},
    {"tiles", "tiles", starter::tiles, 60},
    {"stone", "stone", starter::stone, 60},
    {"roof", "roof", starter::roof, 60},
    {"concrete", "concrete", starter::concrete, 60},
    {"asphalt", "asphalt", starter::asphalt, 50},
    {"dirt", "dirt", starter::dirt, 50},
    {"sand", "sand", starter::sand, 60},
    {"grass", "grass", starter::grass, 60},
    {"lava", "lava", starter::lava, 50},
    {"metal", "metal", starter::metal, 70},
    {"rust", "rust", starter::rust, 60},
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
