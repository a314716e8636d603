// What is asked before edits or a file of the user's are lost: state only, drawn by the question panel.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace viete::scene {

enum class Answer { save, cancel, go_on };

struct Question {
  enum class Kind {
    close,         ///< the program is to end, and unsaved edits could not be kept
    open,          ///< another document is to be taken, and unsaved edits could not be set aside
    replace,       ///< a session is to be saved over one that has changed on disk
    locate_model,  ///< of a session, which is not where it was
    locate_cage,   ///< likewise
    fins,          ///< a cage is opened that has some
    discard        ///< recovered edits are to be deleted
  };
  Kind kind = Kind::close;
  std::string title, text;
  std::string why;         ///< the problem, in its own words; may be empty
  std::size_t chosen = 0;  ///< the answer that Enter gives; always a safe one
};

/// Each says why it is asked; `work` is what may be lost, see name_of_work().
Question ask_before_closing(const std::string& work, const std::string& why);
Question ask_before_opening(const std::string& work, const std::string& why);
Question ask_before_replacing(const std::filesystem::path& session);
/// Again, because saving has failed.
Question ask_after_failed_save(const std::string& work, Question::Kind kind, const std::string& why);

/// key: "model" or "cage".
Question ask_to_locate(std::string_view key, const std::string& problem);
Question ask_to_remove_fins(const std::string& problem);
Question ask_before_discarding(std::size_t count);

/// Other kinds of questions have only the first two.
std::size_t answer_count(Question::Kind kind);
/// What is written on the button of an answer.
const char* label(Question::Kind kind, Answer answer);

}  // namespace viete::scene
