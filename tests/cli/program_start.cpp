#include "tests/cli/program_start.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <mutex>

#include "tests/support/places.h"

namespace weft::test {
namespace {

std::vector<char*> pointers(const std::vector<std::string>& words) {
    std::vector<char*> out;
    out.reserve(words.size() + 1);
    for (const std::string& word : words)
        out.push_back(const_cast<char*>(word.data()));
    out.push_back(nullptr);
    return out;
}

class PlainStart : public Start {
  public:
    explicit PlainStart(const StartRequest& request) {
        const std::vector<char*> words = pointers(request.words),
                                 environment = pointers(request.environment);
        std::fflush(nullptr);
        process_ = fork();
        if (process_ != 0) return;
        if (!request.enter()) _exit(126);
        execve(words[0], words.data(), environment.data());
        _exit(127);
    }
    [[nodiscard]] pid_t process() const override { return process_; }
    std::optional<int> ended(bool at_once) override {
        int status = 0;
        if (waitpid(process_, &status, at_once ? WNOHANG : 0) != process_) return std::nullopt;
        return status;
    }

  private:
    pid_t process_ = -1;
};

// The program that serves starts, from the first one on until the test program ends.
class StartServer {
  public:
    explicit StartServer(const StartRequest& first) {
        int ends[2];
        if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) return;
        std::vector<std::string> variables = first.environment;
        variables.push_back(kStartSocket + ("=" + std::to_string(ends[1])));
        variables.push_back("LD_PRELOAD=" + start_server());
        std::string program = first.words[0];
        // Should nothing be preloaded: what ends at once.
        std::string version = "--version";
        char* const words[] = {program.data(), version.data(), nullptr};
        const std::vector<char*> environment = pointers(variables);
        if (fork() == 0) {
            fcntl(ends[1], F_SETFD, 0);
            execve(words[0], words, environment.data());
            _exit(127);
        }
        close(ends[1]);
        socket_ = ends[0];
    }
    bool ask(const StartRequest& request) {
        const std::string message = request.encoded();
        return message.size() <= kLargestRequest &&
               send(socket_, message.data(), message.size(), MSG_NOSIGNAL) > 0;
    }
    // Empty while there is no answer, if `at_once`. A server that is gone answers `gone`.
    [[nodiscard]] std::optional<int> answer(bool at_once, int gone) const {
        int value = 0;
        for (;;) {
            const ssize_t count = recv(socket_, &value, sizeof value, at_once ? MSG_DONTWAIT : 0);
            if (count == sizeof value) return value;
            if (count < 0 && errno == EINTR) continue;
            if (count < 0 && errno == EAGAIN) return std::nullopt;
            return gone;
        }
    }

  private:
    int socket_ = -1;
};

class ServedStart : public Start {
  public:
    ServedStart(const StartServer& server, std::unique_lock<std::mutex> lock)
        : server_(server), lock_(std::move(lock)), process_(*server.answer(false, -1)) {}
    [[nodiscard]] pid_t process() const override { return process_; }
    std::optional<int> ended(bool at_once) override { return server_.answer(at_once, 127 << 8); }

  private:
    const StartServer& server_;
    std::unique_lock<std::mutex> lock_;
    pid_t process_;
};

}  // namespace

std::unique_ptr<Start> start_program(const StartRequest& request, bool served) {
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    static std::mutex mutex;
    std::unique_lock lock(mutex, std::try_to_lock);
    if (served && lock.owns_lock()) {
        static StartServer server(request);
        if (server.ask(request)) return std::make_unique<ServedStart>(server, std::move(lock));
    }
#endif
    return std::make_unique<PlainStart>(request);
}

}  // namespace weft::test
