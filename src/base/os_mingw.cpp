// UTF-8 for std::filesystem::path, which reads char texts by mbrtowc(). That of MinGW's C library knows no
// UTF-8.
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <cstddef>
#include <cwchar>
#include <utility>

// The linker replaces mbrtowc() by this function (--wrap). A character outside the basic plane gives two
// units: the second one waits in `state`. A byte that is not UTF-8 becomes U+FFFD: such a name of another
// file is then not found, as any wrong name.
extern "C" std::size_t __wrap_mbrtowc(wchar_t* to, const char* from, std::size_t count, mbstate_t* state) {
  constexpr auto incomplete = static_cast<std::size_t>(-2);
  if (from == nullptr) return 0;
  if (count == 0) return incomplete;
  if (*state != 0) {
    *to = static_cast<wchar_t>(std::exchange(*state, 0));
    return 1;
  }
  const auto first = static_cast<unsigned char>(*from);
  const std::size_t length = first < 0xC0 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  wchar_t units[2] = {};
  const int made = count < length ? 0
                                  : MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, from,
                                                        static_cast<int>(length), units, 2);
  if (made == 0) {
    *to = 0xFFFD;
    return 1;
  }
  *to = units[0];
  *state = units[1];
  return first == 0 ? 0 : made == 1 ? length : length - 1;
}
