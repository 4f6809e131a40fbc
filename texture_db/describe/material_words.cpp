#include "texture_db/describe/material_words.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace weft {
namespace {

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}
bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}
bool is_upper(char c) {
    return std::isupper(static_cast<unsigned char>(c)) != 0;
}

// Words that mean a material in file names although an artist would not type them; and words that
// cancel a material's word inside them ("glass" in "grass").
const std::map<std::string, std::string, std::less<>>& path_words() {
    static const auto kPathWords = [] {
        std::map<std::string, std::string, std::less<>> words;
        for (const MaterialEntry& entry : material_table()) {
            words.emplace(entry.name, entry.name);
            for (const std::string& synonym : split_words(entry.synonyms))
                words.emplace(synonym, entry.name);
        }
        for (const auto& [word, material] : {std::pair{"wd", "wood"},
                                             {"plank", "wood"},
                                             {"planks", "wood"},
                                             {"tarmac", "asphalt"},
                                             {"cobbles", "cobblestone"},
                                             {"cliff", "stone"},
                                             {"sandstone", "stone"},
                                             {"rusty", "rust"},
                                             {"rusted", "rust"},
                                             {"trunk", "bark"},
                                             {"lawn", "grass"},
                                             {"soil", "dirt"},
                                             {"mud", "dirt"},
                                             {"tilefloor", "tiles"},
                                             {"floortile", "tiles"},
                                             {"ice", "ice"},
                                             {"metallic", "metal"},
                                             {"steel", "metal"},
                                             {"iron", "metal"},
                                             {"roofing", "roof"},
                                             {"shingles", "roof"},
                                             {"wallpaper", "wallpaper"},
                                             {"cement", "concrete"},
                                             {"stucco", "plaster"},
                                             {"leaves", "foliage"},
                                             {"pebbles", "gravel"},
                                             {"fabric", "fabric"},
                                             {"cloth", "fabric"}}) {
            words.insert_or_assign(word, material);
        }
        // Too ambiguous in file names.
        for (const char* word :
             {"glass", "pane",  "crystal", "window", "board",    "skin",     "hair",
              "coat",  "sheet", "ground",  "field",  "path",     "street",   "road",
              "plate", "panel", "floor",   "wall",   "sky",      "river",    "sea",
              "ocean", "lake",  "pool",    "fire",   "page",     "card",     "slate",
              "china", "wave",  "waves",   "earth",  "flooring", "panelling"})
            words.erase(word);
        return words;
    }();
    return kPathWords;
}

}  // namespace

const std::vector<MaterialEntry>& material_table() {
    static const std::vector<MaterialEntry> kTable{
        {"asphalt", "tarmac bitumen blacktop pavement road street macadam tar", "mineral ground"},
        {"bark", "trunk rind cork treebark", "plant natural tree organic"},
        {"brick", "bricks brickwork bricklaying masonry clinker",
         "building wall mineral construction"},
        {"carpet", "rug mat moquette tapestry pile shag", "textile interior floor cloth covering"},
        {"ceramic", "porcelain china glaze faience earthenware pottery", "mineral glossy hard"},
        {"cloud", "clouds sky overcast haze fog", "natural air weather"},
        {"cobblestone", "cobble cobbles cobbled setts paving pavers sett",
         "stone ground mineral street rock"},
        {"concrete", "cement beton screed", "building mineral wall construction"},
        {"dirt", "soil earth mud loam clay ground turf peat dust compost",
         "natural ground mineral"},
        {"fabric",
         "cloth textile woven weave canvas linen cotton tweed burlap hessian sackcloth denim twill "
         "silk velvet satin tartan plaid gingham jeans sailcloth sacking",
         "clothing soft fibre fiber drapery garment"},
        {"foliage", "leaves leaf hedge ivy bush shrub moss fern jungle undergrowth leafage",
         "plant natural vegetation organic"},
        {"fur", "pelt hair coat mane fleece furry hairy plush sheepskin",
         "animal soft organic natural"},
        {"glass", "pane window crystal", "glossy hard transparent"},
        {"grass", "lawn meadow turf pasture sward", "plant natural ground vegetation organic"},
        {"gravel", "pebble pebbles shingle scree ballast chippings grit grail",
         "mineral ground natural rock stone"},
        {"ice", "icy frost frozen glacier", "natural cold water frozen"},
        {"knit",
         "knitted knitting wool woollen woolen jersey sweater jumper pullover crochet yarn "
         "cardigan",
         "textile clothing soft fibre fiber cloth garment"},
        {"lava", "magma fire molten volcanic embers", "natural hot mineral"},
        {"leather", "hide cowhide suede nappa skin buckskin pigskin saddle",
         "animal clothing organic"},
        {"marble", "travertine onyx alabaster granite terrazzo", "stone mineral polished rock"},
        {"metal",
         "steel iron aluminium aluminum chrome copper brass tin bronze zinc metallic brushed "
         "plating foil",
         "industrial hard shiny"},
        {"paper", "parchment cardboard sheet page papyrus card vellum", "fibre stationery"},
        {"plaster", "stucco render whitewash gypsum adobe mortar",
         "building wall mineral construction"},
        {"roof", "roofing shingles slates rooftiles pantile pantiles slate tiling rooftop",
         "building construction"},
        {"rubber", "tyre tire latex vinyl tread", "industrial soft plastic"},
        {"rust", "rusty rusted corrosion corroded oxidised oxidized rusting verdigris patina",
         "metal industrial old iron"},
        {"sand", "beach dune desert sandy dunes silica", "natural ground mineral"},
        {"skin", "scales reptile scaly flesh snakeskin organic hide", "animal organic natural"},
        {"snow", "snowy powder slush winter snowfield", "natural ground cold frozen"},
        {"stone",
         "rock boulder granite sandstone limestone cliff slate rocky basalt rubble flagstone "
         "stonework masonry",
         "mineral natural wall building"},
        {"straw", "thatch hay reed wicker rattan stubble thatched basket basketry raffia",
         "plant natural fibre organic"},
        {"tiles", "tile tiled tiling mosaic azulejo flooring", "building interior floor wall"},
        {"wallpaper", "wallcovering damask", "interior wall paper"},
        {"water", "sea ocean lake river ripple ripples wave waves pool liquid pond", "natural wet"},
        {"wood",
         "timber wooden plank planks board boards lumber oak pine parquet plywood veneer walnut "
         "mahogany floorboard floorboards panelling hardwood beech teak",
         "plant natural tree organic building construction"},
    };
    return kTable;
}

std::vector<std::string> split_words(std::string_view text) {
    std::vector<std::string> out;
    std::string word;
    for (const char c : text) {
        if (c == ' ' || c == ',' || c == '\t' || c == '\n' || c == ';') {
            if (!word.empty()) out.push_back(std::move(word));
            word.clear();
        } else {
            word += c;
        }
    }
    if (!word.empty()) out.push_back(std::move(word));
    return out;
}

std::string joined_words(const std::vector<std::string>& words) {
    std::string out;
    for (const std::string& word : words) {
        if (!out.empty()) out += ' ';
        out += word;
    }
    return out;
}

std::string words_of_name(std::string_view name) {
    std::string out;
    const auto dot = name.rfind('.');
    if (dot != std::string_view::npos && name.size() - dot <= 5 && dot > 0 &&
        is_letter(name[name.size() - 1]) && name.find(' ', dot) == std::string_view::npos)
        name = name.substr(0, dot);
    const auto gap = [&] {
        if (!out.empty() && out.back() != ' ') out += ' ';
    };
    for (std::size_t i = 0; i < name.size(); ++i) {
        const char c = name[i];
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 128 && !is_letter(c) && !is_digit(c)) {
            gap();
            continue;
        }
        if (i > 0) {
            const char before = name[i - 1];
            const bool hump = is_upper(c) && is_letter(before) && !is_upper(before);
            if (hump || (is_digit(c) && is_letter(before)) || (is_letter(c) && is_digit(before)))
                gap();
        }
        out += static_cast<char>(byte < 128 ? std::tolower(byte) : byte);
    }
    while (!out.empty() && out.back() == ' ')
        out.pop_back();
    return out;
}

std::string singular(const std::string& word) {
    const auto ends = [&](std::string_view e) {
        return word.size() > e.size() + 1 && word.ends_with(e);
    };
    if (word == "leaves") return "leaf";
    if (ends("sses") || ends("shes") || ends("ches") || ends("xes"))
        return word.substr(0, word.size() - 2);
    if (ends("ies") && word.size() > 4) return word.substr(0, word.size() - 3) + "y";
    if (ends("s") && !ends("ss") && !ends("us") && !ends("is"))
        return word.substr(0, word.size() - 1);
    return word;
}

std::string material_of_path(std::string_view path) {
    std::vector<std::string_view> parts;
    for (std::size_t at = 0; at <= path.size();) {
        const std::size_t end = std::min(path.find('/', at), path.size());
        parts.push_back(path.substr(at, end - at));
        at = end + 1;
    }
    for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
        const std::vector<std::string> words = split_words(words_of_name(*part));
        for (auto word = words.rbegin(); word != words.rend(); ++word) {
            for (const std::string& form : {*word, singular(*word)}) {
                if (const auto at = path_words().find(form); at != path_words().end())
                    return at->second;
            }
        }
        // "stonewall", "oldbrick": a material's word at either end of a longer one.
        for (auto word = words.rbegin(); word != words.rend(); ++word) {
            for (const auto& [known, material] : path_words()) {
                if (known.size() >= 4 && word->size() > known.size() &&
                    (word->starts_with(known) || word->ends_with(known)))
                    return material;
            }
        }
    }
    return {};
}

}  // namespace weft
