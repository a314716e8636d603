// Wishes: actions that commands and panels ask the program for, such as reading a file or closing.
#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>

#include "files/open.h"
#include "workspace/messages.h"

namespace viete::workspace {

struct OpenFiles {
  files::OpenRequest request;
};
struct SaveFile {
  enum class Content { session, pose, cage, model, animation };
  Content content;
  std::filesystem::path file;
};
struct CancelWork {
  enum class Work { opening, exporting, report };  ///< opening: also binding and cage generation
  Work work;
};
struct AnswerQuestion {
  Answer answer;
};
struct ShowManual {
  std::string chapter;  ///< empty: the first page
};
struct ShowReport {};
struct SaveScreenshot {};
struct FrameFinding {};  ///< move the camera to the shown finding
struct CloseProgram {};

using Wish = std::variant<OpenFiles, SaveFile, CancelWork, AnswerQuestion, ShowManual, ShowReport,
                          SaveScreenshot, FrameFinding, CloseProgram>;

/// Wishes in the order in which they were added. The program grants them at the beginning of the next frame.
class Wishes {
public:
  void add(Wish wish) { all_.push_back(std::move(wish)); }
  void open(files::OpenRequest request) { add(OpenFiles{std::move(request)}); }
  void save(SaveFile::Content content, std::filesystem::path file) {
    add(SaveFile{content, std::move(file)});
  }

  bool empty() const { return all_.empty(); }
  /// Removes and returns the first wish. Requires that there is one.
  Wish take() {
    Wish first = std::move(all_.front());
    all_.pop_front();
    return first;
  }
  /// Returns the first wish of a type, or null.
  template <class Kind>
  const Kind* find() const {
    for (const Wish& wish : all_)
      if (const Kind* found = std::get_if<Kind>(&wish)) return found;
    return nullptr;
  }
  template <class Kind>
  void drop() {
    std::erase_if(all_, [](const Wish& wish) { return std::holds_alternative<Kind>(wish); });
  }

private:
  std::deque<Wish> all_;
};

}  // namespace viete::workspace
