#pragma once
// What files contain, without reading them again as long as they stay as they are.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/hash.h"
#include "engine/core/input_file.h"

namespace weft {

/// Remembers files by their paths, with their size, times and inode (FileStamp), a sample of their
/// bytes and, of those that were read, the hash of all. Where the stamp differs, or the sample,
/// which is read once by each process, the file is taken to be another one until its bytes prove
/// to be the same. Bytes that were read within two seconds after they were written are read once
/// more later, because a second write could have borne the same time. Thread-safe.
class Fingerprints {
  public:
    using StampFn = std::function<std::optional<FileStamp>(const std::string& path)>;
    /// `folder`: where they are kept for later runs, created when needed; empty: nowhere. Several
    /// processes may share it. `stamp`: how files are looked at, for tests.
    explicit Fingerprints(std::string folder = {}, StampFn stamp = stamp_of);
    /// As save().
    ~Fingerprints();
    Fingerprints(const Fingerprints&) = delete;
    Fingerprints& operator=(const Fingerprints&) = delete;

    /// The hash of the file's bytes as they are now, as hash_of_contents(): the same wherever the
    /// file lies. Errors: as hash_of_contents().
    [[nodiscard]] Expected<Hash128> contents(const std::string& path);
    /// A hash that changes when the file's bytes do, for the names of what is kept in the same
    /// folder. No file is read in full for it, unless it was before and its stamp has changed: it
    /// keeps its id if it was only touched, or replaced by a copy. Errors: as hash_of_sample().
    [[nodiscard]] Expected<Hash128> id(const std::string& path);
    /// Prepares contents() or id() for several files side by side. Errors are left to these.
    void read(const std::vector<std::string>& paths);
    void look_at(const std::vector<std::string>& paths);
    /// Writes what is new to the folder. Nothing depends on it, so errors are ignored.
    void save();
    /// Writes all that is known to another folder too, for processes that will look there.
    void save_to(const std::string& folder);
    /// How many times a file was read in full.
    [[nodiscard]] std::int64_t files_read() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace weft
