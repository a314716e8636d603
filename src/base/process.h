// Which running program is which: a name for this one, and whether a named one still runs.
#pragma once

#include <string>
#include <string_view>

namespace viete::base {

/// "PID-START", START in clock ticks since the machine was started, so that a reused number is another name.
std::string process_name();

/// False for a name that is not of this form, and of a zombie. A process that cannot be looked at counts as
/// ended.
bool process_runs(std::string_view name);

}  // namespace viete::base
