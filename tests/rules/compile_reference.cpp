// What compiling the rooms is compared with; a change here would make the limit mean something else.
#include <algorithm>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <unordered_map>
#include <vector>

namespace viete::rules {

using Count = std::pair<std::string, int>;
using Taken = std::function<bool(const std::string&)>;

std::vector<Count> commonest_words(const std::string& text, const Taken& is_taken) {
  std::unordered_map<std::string, int> counts;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (is_taken(word)) ++counts[word];
  }
  std::map<int, std::vector<std::string>, std::greater<>> by_count;
  for (const auto& [word, count] : counts) by_count[count].push_back(word);
  std::vector<Count> sorted;
  for (auto& [count, all] : by_count) {
    std::stable_sort(all.begin(), all.end());
    for (const std::string& word : all) sorted.emplace_back(word, count);
  }
  return sorted;
}

}  // namespace viete::rules
