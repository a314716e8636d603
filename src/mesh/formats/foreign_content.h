// Content of files that is often met where a model, an animation or a session is looked for.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace viete::mesh {

/// Throws base::Error that says what it is and what to do, where the bytes at the beginning of a file are
/// those of something else that is known: a Git LFS pointer, a compressed file, a web page, another format.
void refuse_foreign(const std::string& name, std::string_view bytes);

/// True if the beginning has control characters that no text has.
bool looks_binary(std::string_view bytes);

/// "a picture (PNG)", "a web page", "JSON", "text", "binary data".
std::string_view name_of_content(std::string_view beginning);

/// The text at the end of these keys, of JSON that may be cut off; empty if there is none.
std::string text_in_json(std::string_view beginning, std::initializer_list<std::string_view> keys);

}  // namespace viete::mesh
