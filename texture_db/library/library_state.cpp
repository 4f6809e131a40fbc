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

Status TextureLibrary::State::read_embeddings() {
    if (embeddings_tried && embeddings_changes == loaded_changes) return {};
    embeddings_tried = true;
    embeddings_changes = loaded_changes;
    embeddings.reset();
    embedding_fault.clear();
    WEFT_TRY(folder, text_note(*database, kModelFolderNote));
    if (folder.empty()) {
        embedding_model.reset();
        return {};
    }
    // Another process may have set another model, or encoded again with changed files.
    WEFT_TRY(identity, text_note(*database, kModelIdentityNote));
    if (embedding_model && embedding_model->identity() != identity) embedding_model.reset();
    if (!embedding_model) {
        auto opened = ImageTextModel::open(folder);
        if (!opened) {
            embedding_fault = opened.error().sentence();
            return {};
        }
        embedding_model = std::move(*opened);
    }
    if (identity != embedding_model->identity()) {
        embedding_fault =
            "The image–text model " + folder +
            " has changed since the library was encoded with it. Encode the library again" +
            by({{setting::kUseModel, folder}}) + ".";
        return {};
    }
    WEFT_TRY(loaded, load_embeddings(*database, *index, embedding_model->dimensions()));
    embeddings = std::move(loaded);
    return {};
}

Expected<LibraryEmbeddings> TextureLibrary::State::open_embeddings() {
    WEFT_CHECK_OK(read_embeddings());
    LibraryEmbeddings out;
    if (embedding_model && embeddings) {
        out.model = &*embedding_model;
        out.samples = &*embeddings;
    }
    out.fault = embedding_fault;
    return out;
}

}  // namespace weft
