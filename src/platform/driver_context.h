// The system's own OpenGL without a visible window: egl_context.cpp or, on Windows, hidden_window.cpp.
#pragma once

#include <memory>

#include "base/os.h"
#include "platform/offscreen_context.h"

namespace viete::platform {

/// Throws base::Error with the reason if no context can be created.
std::unique_ptr<OffscreenContext> make_driver_context();

// A function of a library, for conversion to its type.
struct Function {
  void* address;
  template <class Pointer>
  operator Pointer() const {
    return reinterpret_cast<Pointer>(address);
  }
};

class Library : public base::os::Library {
public:
  using base::os::Library::Library;
  Function find(const char* name) const { return {base::os::Library::find(name)}; }
};

}  // namespace viete::platform
