// Content of files that is often met where a model, an animation or a session is looked for.
#pragma once

#include <string>
#include <string_view>

namespace viete::mesh {

/// Throws base::Error that says what it is and what to do, where the bytes at the beginning of a file are
/// those of something else that is known: a Git LFS pointer, a compressed file, a web page, another format.
void refuse_foreign(const std::string& name, std::string_view bytes);

}  // namespace viete::mesh
