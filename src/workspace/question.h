// Questions to the user before edits or files are lost.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace viete::workspace {

enum class Answer { save, cancel, proceed };

struct Question {
  enum class Kind {
    close,         ///< closing the program with edits that could not be saved for recovery
    open,          ///< opening another document with edits that could not be saved for recovery
    replace,       ///< overwriting a session that changed on disk
    locate_model,  ///< the model of a session is missing
    locate_cage,   ///< the cage of a session is missing
    fins,          ///< opening a cage that has fins
    discard        ///< deleting recovered edits
  };
  Kind kind = Kind::close;
  std::string title, text;
  std::string why;         ///< the reported cause; may be empty
  std::size_t chosen = 0;  ///< index of the answer that Enter gives; at first a safe answer
};

/// `work` is the name of the unsaved work, see name_of_work().
Question ask_before_closing(const std::string& work, const std::string& why);
Question ask_before_opening(const std::string& work, const std::string& why);
Question ask_before_replacing(const std::filesystem::path& session);
Question ask_after_failed_save(const std::string& work, Question::Kind kind, const std::string& why);

/// key: "model" or "cage".
Question ask_to_locate(std::string_view key, const std::string& problem);
Question ask_to_remove_fins(const std::string& problem);
Question ask_before_discarding(std::size_t count);

/// The number of answers of a question: 2 if only the first two are used, otherwise 3.
std::size_t answer_count(Question::Kind kind);
/// The caption of an answer's button.
const char* label(Question::Kind kind, Answer answer);

}  // namespace viete::workspace
