// Threads, where limits on processes or address space may leave none to make.
#pragma once

#include <exception>
#include <thread>
#include <utility>

namespace viete::base {

/// A thread that runs the work, which may take a std::stop_token; not joinable if the system refuses it.
template <class Work>
std::jthread try_thread(Work work) {
  try {
    return std::jthread(std::move(work));
  } catch (const std::exception&) {  // std::system_error, std::bad_alloc
    return {};
  }
}

}  // namespace viete::base
