#include "app/cli/licences.h"

#include "app/cli/commands.h"
#include "engine/media/movies.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

std::string licence_line(const Json& library) {
    const std::string version = library["version"];
    return library["name"].get<std::string>() + (version.empty() ? "" : " " + version) + " (" +
           library["linked"].get<std::string>() + "): " + library["licence"].get<std::string>() +
           "; " + library["used_for"].get<std::string>() + "\n";
}

}  // namespace

Answer licences_answer() {
    Answer answer = version_answer();
    answer.json["licence"] = kWeftLicence;
    answer.json["movies"] = movie_library();
    answer.json["libraries"] = Json::array();
    answer.text += std::string("Licence of Weft: ") + kWeftLicence + "\n";
    for (const Json& library : Json::parse(kLibrariesJson)) {
        if (!library["inside"].get<bool>()) continue;
        Json entry;
        for (const char* key :
             {"name", "version", "licence", "linked", "used_for", "obliges", "notice"})
            entry[key] = library[key];
        answer.text += licence_line(entry);
        answer.json["libraries"].push_back(std::move(entry));
    }
    const std::string movies = movie_library();
    answer.text += "Movies: " + (movies.empty() ? "not in this build" : movies) +
                   "\nObligations: docs/LICENCES.md\n";
    return answer;
}

}  // namespace weft
