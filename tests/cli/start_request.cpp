#include "tests/cli/start_request.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace weft::test {
namespace {

constexpr char kEnd = '\0';  // in no word that a program can be given

void write_to(const std::string& path, int descriptor) {
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0) return;
    dup2(file, descriptor);
    close(file);
}

}  // namespace

std::string StartRequest::encoded() const {
    std::string out;
    for (const std::string& text : {folder, out_path, err_path, std::to_string(largest_file_bytes),
                                    std::to_string(words.size())})
        out += text + kEnd;
    for (const auto* list : {&words, &environment})
        for (const std::string& text : *list)
            out += text + kEnd;
    return out;
}

StartRequest StartRequest::decoded(std::string_view bytes) {
    const auto next = [&] {
        const std::size_t end = bytes.find(kEnd);
        std::string text(bytes.substr(0, end));
        bytes.remove_prefix(end + 1);
        return text;
    };
    StartRequest out;
    out.folder = next();
    out.out_path = next();
    out.err_path = next();
    out.largest_file_bytes = std::stoull(next());
    out.words.resize(std::stoull(next()));
    for (std::string& word : out.words)
        word = next();
    while (!bytes.empty())
        out.environment.push_back(next());
    return out;
}

bool StartRequest::enter() const {
    write_to(out_path, STDOUT_FILENO);
    write_to(err_path, STDERR_FILENO);
    if (chdir(folder.c_str()) != 0) return false;
    if (largest_file_bytes > 0) {
        const rlimit limit{largest_file_bytes, largest_file_bytes};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    return true;
}

}  // namespace weft::test
