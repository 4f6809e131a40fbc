#include "texture_db/library/library_state.h"

#include "engine/core/setting.h"

namespace weft {

Status TextureLibrary::State::refresh() {
    // data_version detects writes by other connections; the change count detects this connection's
    // own.
    WEFT_TRY(version, database->number("PRAGMA data_version"));
    WEFT_TRY(changes, database->number("SELECT count FROM changes"));
    if (index && version == loaded_data_version && changes == loaded_changes) return {};
    if (!index || changes != loaded_changes) {
        WEFT_TRY(loaded, load_index(*database));
        WEFT_TRY(reader, WordReader::load(*database, loaded));
        auto trained = stored_model(*database);
        if (!trained) return tl::unexpected(std::move(trained).error());
        model = std::move(*trained);
        index = std::move(loaded);
        words = std::move(reader);
    }
    loaded_data_version = version;
    loaded_changes = changes;
    return {};
}

Status TextureLibrary::State::read_sight() {
    if (sight_tried && sight_changes == loaded_changes) return {};
    sight_tried = true;
    sight_changes = loaded_changes;
    sight.reset();
    sight_fault.clear();
    WEFT_TRY(folder, text_note(*database, kSightFolderNote));
    if (folder.empty()) {
        sight_model.reset();
        return {};
    }
    // Another process may have set another model, or encoded again with changed files.
    WEFT_TRY(identity, text_note(*database, kSightIdentityNote));
    if (sight_model && sight_model->identity() != identity) sight_model.reset();
    if (!sight_model) {
        auto opened = ImageTextModel::open(folder);
        if (!opened) {
            sight_fault = opened.error().message;
            return {};
        }
        sight_model = std::move(*opened);
    }
    if (identity != sight_model->identity()) {
        sight_fault =
            "The image–text model " + folder +
            " has changed since the library was encoded with it. Encode the library again" +
            by({{setting::kUseModel, folder}}) + ".";
        return {};
    }
    WEFT_TRY(loaded, load_sight(*database, *index, sight_model->dimensions()));
    sight = std::move(loaded);
    return {};
}

Expected<LibrarySight> TextureLibrary::State::open_sight() {
    WEFT_CHECK_OK(read_sight());
    LibrarySight out;
    if (sight_model && sight) {
        out.model = &*sight_model;
        out.samples = &*sight;
    }
    out.fault = sight_fault;
    return out;
}

}  // namespace weft
