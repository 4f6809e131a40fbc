#include <algorithm>
#include <string>

#include "texture_db/describe/material_words.h"
#include "texture_db/describe/surface_role.h"

namespace weft {
namespace {

struct RoleVocabulary {
    SurfaceRole role;
    std::string_view words;
};

// What artists call regions; singular.
constexpr RoleVocabulary kVocabulary[]{
    {SurfaceRole::kWall,
     "wall facade building house column pillar ceiling tower fence chimney arch castle bridge "
     "backdrop room interior cliff structure graffiti fireplace gate hall shed barn ruin"},
    {SurfaceRole::kGround,
     "ground floor road street path pavement field terrain yard courtyard land court deck stage "
     "beach lawn meadow track trail lane pitch arena garden verge bank slope hill hillside "
     "mountain "
     "soil mud earth sidewalk driveway runway pasture desert dune shore platform"},
    {SurfaceRole::kRoof, "roof rooftop canopy awning"},
    {SurfaceRole::kGarment,
     "garment clothing clothes cloth fabric dress skirt shirt sleeve cape coat jacket trouser pant "
     "hat scarf glove robe tunic cloak costume sweater jumper blouse suit vest hood hoodie sock "
     "shoe boot apron uniform curtain drape flag sail cushion pillow blanket towel rug carpet sofa "
     "footwear headdress textile tee tshirt jean legging stocking gown veil shawl turban kimono "
     "sari tie ribbon cuff collar bedspread bedcover bedding bedclothes bed duvet quilt comforter "
     "mattress pillowcase couch armchair upholstery tablecloth napkin banner tent backpack short "
     "pyjama pajama cardigan pullover bag handbag cap beanie belt hammock parachute man woman boy "
     "girl child person people player dancer rider cyclist runner skater actor actress worker"},
    {SurfaceRole::kCoat,
     "fur coat skin body animal creature monster dog cat fox bear horse bird swan dragon lizard "
     "snake fish tail paw wing feather mane head leg character hair beast cow bull calf goat sheep "
     "lamb pig donkey camel elephant lion tiger wolf rabbit mouse monkey deer duck goose hen "
     "chicken dinosaur arm hand face"},
    {SurfaceRole::kProp,
     "prop ball box crate barrel table chair vase statue car vehicle robot door sword "
     "shield armour armor rock boulder slab stump trunk furniture container weapon instrument "
     "truck lorry bus van bike bicycle motorbike boat ship train plane cup mug pot kettle bottle "
     "jug plate bowl lamp cabinet cupboard drawer shelf desk bench counter worktop can tin phone "
     "toy block cube log branch"},
    {SurfaceRole::kElement, "water sea lake river sky cloud lava fire ice ocean smoke pond pool"},
};

bool holds(std::string_view words, const std::string& word) {
    const std::vector<std::string> all = split_words(words);
    return std::find(all.begin(), all.end(), word) != all.end();
}

// Marks the roles that a word names.
bool mark(const std::string& word, RoleWeights& named) {
    bool found = false;
    for (const RoleVocabulary& entry : kVocabulary) {
        if (!holds(entry.words, word)) continue;
        named[static_cast<std::size_t>(entry.role)] = 1;
        found = true;
    }
    return found;
}

bool mark_all(const std::string& words, RoleWeights& named) {
    bool found = false;
    for (const std::string& word : split_words(words)) {
        if (mark(word, named) || mark(singular(word), named)) {
            found = true;
        } else if (const std::string material = material_of_path(word); !material.empty()) {
            const RoleWeights roles = roles_of_material(material);
            for (std::size_t r = 0; r < kSurfaceRoles; ++r)
                named[r] = std::max(named[r], roles[r]);
            found = true;
        }
    }
    return found;
}

}  // namespace

RoleWeights roles_of_name(std::string_view name) {
    RoleWeights named{};
    // A region's name, or the path of its matte: the folder is used if the file name is a number.
    for (int part = 0; part < 2 && !name.empty(); ++part) {
        const auto slash = name.rfind('/');
        if (mark_all(words_of_name(name.substr(slash + 1)), named)) return named;
        name = slash == std::string_view::npos ? std::string_view() : name.substr(0, slash);
    }
    named.fill(1);
    return named;
}

}  // namespace weft
