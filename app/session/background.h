#pragma once

namespace weft {

/// Gives way to the window: the calling thread, and threads that it starts, run at a lower priority
/// from now on.
void lower_thread_priority();

}  // namespace weft
