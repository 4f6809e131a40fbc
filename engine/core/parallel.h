#pragma once
#include <cstddef>
#include <functional>

#include "engine/core/error.h"

namespace weft {

/// How many threads parallel work may use, the caller included. 0 means one for each processor that
/// this process may run on. Affects calls that start later. Not to be called inside parallel work.
void set_thread_count(int count);
[[nodiscard]] int thread_count();

/// Calls body(i) for every i in [0, n), on up to thread_count() threads, in no order. Returns when
/// all are done. Each index must write only what no other index touches; then results do not depend
/// on the number of threads. Inside a body: in the calling thread, helped by threads without work.
/// An exception from a body is rethrown here after the others have finished.
void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body);

/// The same for bodies that may fail: all are called, and the error of the lowest index is
/// returned.
[[nodiscard]] Status parallel_try(std::size_t n, const std::function<Status(std::size_t)>& body);

/// The same over bands of rows: body(y0, y1) for consecutive bands of [0, height) of `band` rows.
/// Bands do not depend on the number of threads.
void parallel_rows(int height, int band, const std::function<void(int, int)>& body);

}  // namespace weft
