// Loading the libraries of weft takes a quarter of a second, most of it symbols that are bound anew
// in each process. Preloaded into the program (LD_PRELOAD), this serves starts instead: when
// everything is loaded, and before the program's own code runs, it waits for requests
// (start_request.h) and lets a copy of the process go on for each. What runs is the program itself,
// from its first static object on.
#include <dlfcn.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <vector>

#include "tests/cli/start_request.h"

namespace {

using weft::test::StartRequest;
using Main = int (*)(int, char**, char**);
using Function = void (*)();
using StartMain = int (*)(Main, int, char**, Function, Function, Function, void*);

// Libraries end here: some wait in their destructors for threads that they started when they were
// loaded, and a copy of a process has no threads but one.
void end_at_once(int status, void*) {
    std::cout.flush();
    std::fflush(nullptr);
    _exit(status);
}

// As in another start, nothing lies where it lay in the last one.
void shift_memory() {
    unsigned short drawn[2] = {};
    if (getrandom(drawn, sizeof drawn, 0) != sizeof drawn) _exit(126);
    static void* volatile kept = nullptr;  // or the compiler leaves it out
    kept = std::malloc(16 + drawn[0] % 65536);
    if (!kept) _exit(126);
    (void)mmap(nullptr, 4096 * (1 + static_cast<std::size_t>(drawn[1] % 1024)), PROT_NONE,
               MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
}

void become(const StartRequest& request) {
    if (!request.enter()) _exit(126);
    on_exit(end_at_once, nullptr);
    shift_memory();
}

std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> out;
    out.reserve(words.size() + 1);
    for (std::string& word : words)
        out.push_back(word.data());
    out.push_back(nullptr);
    return out;
}

// Answers one request after the other; returns in the copy that is to go on.
StartRequest serve(int socket) {
    std::vector<char> bytes(weft::test::kLargestRequest);
    for (;;) {
        const ssize_t count = recv(socket, bytes.data(), bytes.size(), 0);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) _exit(0);
        StartRequest request =
            StartRequest::decoded({bytes.data(), static_cast<std::size_t>(count)});
        const pid_t child = fork();
        if (child == 0) {
            close(socket);
            become(request);
            return request;
        }
        int status = 0;
        if (send(socket, &child, sizeof child, MSG_NOSIGNAL) < 0 || child < 0) _exit(1);
        while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
        }
        if (send(socket, &status, sizeof status, MSG_NOSIGNAL) < 0) _exit(1);
    }
}

}  // namespace

// The C library's name. NOLINTNEXTLINE(bugprone-reserved-identifier)
extern "C" int __libc_start_main(Main main, int argc, char** argv, Function init, Function fini,
                                 Function loader_fini, void* stack_end) {
    const auto start = reinterpret_cast<StartMain>(dlsym(RTLD_NEXT, "__libc_start_main"));
    // One thread. NOLINTNEXTLINE(concurrency-mt-unsafe)
    const char* socket = std::getenv(weft::test::kStartSocket);
    if (!socket) return start(main, argc, argv, init, fini, loader_fini, stack_end);
    // For as long as the process.
    auto& request = *new StartRequest(serve(std::atoi(socket)));
    auto& words = *new std::vector<char*>(pointers(request.words));
    environ = (new std::vector<char*>(pointers(request.environment)))->data();
    return start(main, static_cast<int>(request.words.size()), words.data(), init, fini, nullptr,
                 stack_end);
}
