// weft texture mark and weft texture kept: favourites, ratings, collections and saved searches.

#include <memory>
#include <optional>

#include "app/cli/command_line.h"
#include "app/cli/option_values.h"
#include "app/cli/texture/texture_commands.h"
#include "app/cli/texture/texture_console.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;
constexpr int kRecentShown = 50;

struct MarkOptions {
    std::vector<std::string> ids;
    bool favourite = false, no_favourite = false;
    std::optional<int> rating;
    std::string collect, uncollect, material;
    std::optional<std::vector<std::string>> tags;

    [[nodiscard]] bool empty() const {
        return !favourite && !no_favourite && !rating && collect.empty() && uncollect.empty() &&
               material.empty() && !tags;
    }
};

struct KeptOptions {
    std::string save_search, words;
    std::string delete_search, delete_collection;
};

Status mark_one(TextureLibrary& library, const std::string& id, const MarkOptions& o) {
    if (o.favourite || o.no_favourite) WEFT_CHECK_OK(library.set_favourite(id, o.favourite));
    if (o.rating) WEFT_CHECK_OK(library.set_rating(id, *o.rating));
    if (!o.collect.empty()) WEFT_CHECK_OK(library.add_to_collection(o.collect, id));
    if (!o.uncollect.empty()) WEFT_CHECK_OK(library.remove_from_collection(o.uncollect, id));
    if (!o.material.empty()) WEFT_CHECK_OK(library.set_material(id, o.material));
    if (o.tags) WEFT_CHECK_OK(library.set_tags(id, *o.tags));
    return {};
}

// Looks up all ids before changing the first sample, so an unknown id changes nothing.
CommandResult mark(const TextureCommandOptions& common, const MarkOptions& o) {
    if (o.empty())
        return fail(ErrorCode::kUsage, "Nothing to do.",
                    "Give --favourite, --rating, --collect, --material or --tags.");
    WEFT_TRY(library, open_texture_library(common, false));
    std::vector<std::string> ids;
    for (const std::string& id : o.ids) {
        WEFT_TRY(info, library->info(id));
        ids.push_back(info.id);
    }
    for (const std::string& id : ids)
        WEFT_CHECK_OK(mark_one(*library, id, o));
    return Answer{{{"marked", ids}}, std::to_string(ids.size()) + " marked\n"};
}

CommandResult kept(const TextureCommandOptions& common, const KeptOptions& o) {
    WEFT_TRY(library, open_texture_library(common, false));
    if (!o.save_search.empty()) {
        SearchQuery query;
        query.text = o.words;
        WEFT_CHECK_OK(library->save_search(o.save_search, query));
    }
    if (!o.delete_search.empty()) WEFT_CHECK_OK(library->delete_saved_search(o.delete_search));
    if (!o.delete_collection.empty())
        WEFT_CHECK_OK(library->delete_collection(o.delete_collection));
    WEFT_TRY(collections, library->collections());
    WEFT_TRY(searches, library->saved_searches());
    WEFT_TRY(recent, library->recent(kRecentShown));
    SearchQuery favourites;
    favourites.favourites_only = true;
    favourites.limit = 0;
    WEFT_TRY(favourite, library->search(favourites));
    Answer answer;
    answer.json = {{"favourites", favourite.total},
                   {"collections", Json::object()},
                   {"searches", Json::object()},
                   {"recent", recent}};
    answer.text = std::to_string(favourite.total) + " favourites, " +
                  std::to_string(recent.size()) + " used lately\n";
    for (const FacetCount& c : collections) {
        answer.json["collections"][c.value] = c.count;
        answer.text += "collection  " + c.value + "  " + std::to_string(c.count) + "\n";
    }
    for (const SavedSearch& s : searches) {
        answer.json["searches"][s.name] = s.text;
        answer.text += "search      " + s.name + "  " + s.text + "\n";
    }
    return answer;
}

void add_mark(CLI::App& group, CommandResult& result) {
    const auto common = std::make_shared<TextureCommandOptions>();
    const auto o = std::make_shared<MarkOptions>();
    CLI::App* command = add_texture_subcommand(
        group, "mark", "Set favourites, ratings, collections, materials and tags of samples",
        common);
    command->add_option("ids", o->ids, "Ids, or prefixes of 6 digits or more")
        ->required()
        ->type_name("ID");
    CLI::Option* favourite = command->add_flag("--favourite", o->favourite, "Mark as favourite");
    command->add_flag("--no-favourite", o->no_favourite, "Remove from favourites")
        ->excludes(favourite);
    command->add_option("--rating", o->rating, "Stars; 0: none")->transform(whole_number(0, 5));
    command->add_option("--collect", o->collect, "Add to this collection")->type_name("NAME");
    command->add_option("--uncollect", o->uncollect, "Remove from this collection")
        ->type_name("NAME");
    command->add_option("--material", o->material, "Correct the material");
    command->add_option("--tags", o->tags, "Search words, replacing the present ones")
        ->delimiter(',');
    command->footer("Example:\n  weft texture mark 612e90 2bc904 --favourite --collect walls");
    on_run(*command, result, [=] { return mark(*common, *o); });
}

void add_kept(CLI::App& group, CommandResult& result) {
    const auto common = std::make_shared<TextureCommandOptions>();
    const auto o = std::make_shared<KeptOptions>();
    CLI::App* command = add_texture_subcommand(
        group, "kept", "Collections, saved searches and recently used samples", common);
    CLI::Option* save =
        command->add_option("--save-search", o->save_search, "Save a search under this name")
            ->type_name("NAME");
    command->add_option("--words", o->words, "Words of the search")->needs(save);
    command->add_option("--delete-search", o->delete_search, "Delete a search")->type_name("NAME");
    command
        ->add_option("--delete-collection", o->delete_collection,
                     "Delete a collection; its samples stay")
        ->type_name("NAME");
    command->footer(
        "Example:\n  weft texture kept --save-search walls --words \"rough grey stone\"");
    on_run(*command, result, [=] { return kept(*common, *o); });
}

}  // namespace

void add_texture_keeping(CLI::App& group, CommandResult& result) {
    add_mark(group, result);
    add_kept(group, result);
}

}  // namespace weft
