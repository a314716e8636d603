// Libraries that are loaded at run time, with functions of any type.
#pragma once

#include "base/os.h"

namespace viete::platform {

/// A function of a library. Converts to a pointer of the function's type.
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
