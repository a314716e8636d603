// Where, when and by what a report is made.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace viete::bench {

struct Made {
  std::string command;    ///< as it was typed
  std::string date;       ///< "2026-11-26 11:18 UTC"
  std::string program;    ///< version, build, compiler
  std::string kernel;     ///< of the vector code
  std::string processor;  ///< with the number of its threads
  std::string memory, system;
  double seconds = 0;  ///< that it took
};

/// Of this machine, now.
Made made_here(std::string command, double seconds);

/// Each with what it is called, in the order of reading.
std::vector<std::pair<std::string, std::string>> facts_of(const Made& made);
nlohmann::json to_json(const Made& made);

}  // namespace viete::bench
