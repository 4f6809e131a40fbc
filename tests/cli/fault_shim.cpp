// Fault injection by LD_PRELOAD. WEFT_FAULT is "CALL N KIND PART [once]": from the N-th CALL
// (write, read, fsync, rename) on a file whose path contains PART, every call fails with KIND
// (ENOSPC, EIO), transfers only half of the bytes (short) or takes 2 ms (slow). With "once", only
// the N-th call.
#include <dlfcn.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Plan {
    char call[16] = "", kind[16] = "", part[256] = "", once[8] = "";
    long from = 0;
    Plan() {
        if (const char* text = std::getenv("WEFT_FAULT"))
            std::sscanf(text, "%15s %ld %15s %255s %7s", call, &from, kind, part, once);
    }
};

// Returns true if this call of `name` on `path` must fail.
bool strikes(const char* name, const char* path) {
    static const Plan plan;
    static std::atomic<long> count{0};
    if (std::strcmp(plan.call, name) != 0 || !std::strstr(path, plan.part)) return false;
    const long n = ++count;
    return plan.once[0] ? n == plan.from : n >= plan.from;
}

const char* kind() {
    static const Plan plan;
    return plan.kind;
}

// Returns false if the descriptor has no path.
bool path_of(int file, char (&path)[PATH_MAX]) {
    char link[64];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t n = readlink(link, path, sizeof path - 1);
    path[n < 0 ? 0 : n] = 0;
    return n >= 0;
}

bool strikes(const char* name, int file) {
    char path[PATH_MAX];
    return path_of(file, path) && strikes(name, path);
}

bool strikes_in(const char* name, int folder, const char* file) {
    char path[PATH_MAX], whole[2 * PATH_MAX];
    if (!path_of(folder, path)) return strikes(name, file);
    std::snprintf(whole, sizeof whole, "%s/%s", path, file);
    return strikes(name, whole);
}

// Returns false if the call proceeds normally.
bool fail_or_wait() {
    if (std::strcmp(kind(), "slow") == 0) {
        usleep(2000);
        return false;
    }
    if (std::strcmp(kind(), "short") == 0) return false;
    errno = std::strcmp(kind(), "ENOSPC") == 0 ? ENOSPC : EIO;
    return true;
}

template <class F>
F next(const char* name) {
    return reinterpret_cast<F>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* data, size_t size) {
    static const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
    if (!strikes("write", file)) return real(file, data, size);
    if (fail_or_wait()) return -1;
    return real(file, data, std::strcmp(kind(), "short") == 0 && size > 1 ? size / 2 : size);
}

ssize_t read(int file, void* data, size_t size) {
    static const auto real = next<ssize_t (*)(int, void*, size_t)>("read");
    if (!strikes("read", file)) return real(file, data, size);
    if (fail_or_wait()) return -1;
    return real(file, data, std::strcmp(kind(), "short") == 0 && size > 1 ? size / 2 : size);
}

ssize_t pread64(int file, void* data, size_t size, off64_t at) {
    static const auto real = next<ssize_t (*)(int, void*, size_t, off64_t)>("pread64");
    if (!strikes("read", file)) return real(file, data, size, at);
    if (fail_or_wait()) return -1;
    return real(file, data, std::strcmp(kind(), "short") == 0 && size > 1 ? size / 2 : size, at);
}

ssize_t pread(int file, void* data, size_t size, off_t at) {
    return pread64(file, data, size, at);
}

size_t fread(void* data, size_t size, size_t count, FILE* stream) {
    static const auto real = next<size_t (*)(void*, size_t, size_t, FILE*)>("fread");
    if (!strikes("read", fileno(stream))) return real(data, size, count, stream);
    if (fail_or_wait()) return 0;
    return real(data, size, count, stream);
}

int fsync(int file) {
    static const auto real = next<int (*)(int)>("fsync");
    if (!strikes("fsync", file) || !fail_or_wait()) return real(file);
    return -1;
}

int rename(const char* from, const char* to) {
    static const auto real = next<int (*)(const char*, const char*)>("rename");
    if (!strikes("rename", to) || !fail_or_wait()) return real(from, to);
    return -1;
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) {
    static const auto real = next<int (*)(int, const char*, int, const char*)>("renameat");
    if (!strikes_in("rename", to_folder, to) || !fail_or_wait())
        return real(from_folder, from, to_folder, to);
    return -1;
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
    static const auto real =
        next<int (*)(int, const char*, int, const char*, unsigned)>("renameat2");
    if (!strikes_in("rename", to_folder, to) || !fail_or_wait())
        return real(from_folder, from, to_folder, to, flags);
    return -1;
}
}
