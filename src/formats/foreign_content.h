// Detects files of other kinds that users often open by mistake.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace viete::formats {

/// If the file is empty or of a known kind that cannot be read (a compressed file, a web page, a Blender
/// file, ...), throws base::Error with advice. `bytes` is the beginning of the file.
void refuse_foreign(const std::string& name, std::string_view bytes);

/// Returns true if the first 4096 bytes contain control characters that do not occur in text.
bool looks_binary(std::string_view bytes);

/// Names the content for messages: "a picture (PNG)", "a web page", "JSON", "text", "binary data".
std::string_view name_of_content(std::string_view beginning);

/// Returns the string at keys[0], keys[1], ... in nested JSON, or "". The JSON can be truncated.
std::string text_in_json(std::string_view beginning, std::initializer_list<std::string_view> keys);

}  // namespace viete::formats
