#include "bench/made.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <thread>
#include <utility>

#include "app/build_facts.h"
#include "base/text.h"
#include "bench/table.h"
#include "sym3/kernel.h"

namespace viete::bench {

namespace {

std::string date_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &utc);
  return text;
}

std::string system_name() {
  utsname names{};
  if (uname(&names) != 0) return "";
  return std::string(names.sysname) + " " + names.release + ", " + names.machine;
}

}  // namespace

Made made_here(std::string command, double seconds) {
  const std::string processor = processor_name();
  const double bytes =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  return {std::move(command),
          date_now(),
          std::string("viete ") + app::version() + ", " + app::build_type(),
          std::string(sym3::kernel_name()),
          (processor.empty() ? "a processor without a name" : processor) + ", " +
              base::counted(std::thread::hardware_concurrency(), "thread"),
          base::memory_size(bytes),
          system_name(),
          seconds};
}

std::vector<std::pair<std::string, std::string>> facts_of(const Made& made) {
  return {{"Machine", made.processor},
          {"Memory", made.memory},
          {"System", made.system},
          {"Program", made.program},
          {"Kernel of the vector code", made.kernel},
          {"Made", made.date + ", in " + base::few_digits(made.seconds) + " s"},
          {"By", made.command}};
}

nlohmann::json to_json(const Made& made) {
  nlohmann::json json;
  for (const auto& [what, value] : facts_of(made)) json[what] = value;
  return json;
}

}  // namespace viete::bench
