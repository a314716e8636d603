#include "base/picture.h"

#include <doctest/doctest.h>

#include <string>

#include "base/error.h"
#include "support/data.h"
#include "support/folder.h"

using namespace viete;

TEST_CASE("pictures_keep_their_channels_or_get_the_requested_ones") {
  const std::vector<std::uint8_t> grey = {0, 50, 100, 150, 200, 250};
  const std::string png = base::encode_png("grey", 3, 2, 1, grey);
  const base::Picture same = base::decode_picture("grey", png);
  CHECK(same.width == 3);
  CHECK(same.height == 2);
  CHECK(same.channels == 1);
  CHECK(same.bytes == grey);
  const base::Picture four = base::decode_picture("grey", png, 4);
  CHECK(four.channels == 4);
  CHECK(four.bytes.size() == 24);
  CHECK(four.bytes[4] == 50);
  CHECK(four.bytes[7] == 255);
  CHECK_THROWS_AS(base::encode_png("grey", 3, 3, 1, grey), base::Error);
}

TEST_CASE("pictures_of_hostile_size_are_refused_before_they_are_decoded") {
  using namespace std::string_literals;
  const auto refusal = [](const std::string& bytes) {
    try {
      base::decode_picture("given", bytes);
    } catch (const base::Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto png = [](const std::string& size) {
    return "\x89PNG\r\n\x1a\n\0\0\0\rIHDR"s + size + "\x08\6\0\0\0\0\0\0\0\0\0\0\4IDATabcd\0\0\0\0"s;
  };
  CHECK(refusal(png("\x7f\xff\xff\xff\x7f\xff\xff\xff")) != "");
  CHECK(refusal(png("\x80\0\0\0\x80\0\0\0"s)) != "");
  CHECK(refusal(png("\0\0\x40\0\0\0\x40\0"s)).find("16384 x 16384 pixels") != std::string::npos);
  CHECK(refusal(png("\0\0\x75\x30\0\0\x75\x30"s)).find("30000 x 30000 pixels") != std::string::npos);
  const std::string tga = "\0\0\xA\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff\x20\0\xff\0\0\0\0"s;
  CHECK(refusal(tga).find("65535 x 65535 pixels") != std::string::npos);
  const std::string jpeg = "\xff\xd8\xff\xc0\0\x0b\x08\xff\xdc\xff\xdc\1\1\x11\0"s;
  CHECK(refusal(jpeg).find("65500 x 65500 pixels") != std::string::npos);
  CHECK(refusal(png("\0\0\0\2\0\0\0\2"s)).find("damaged") != std::string::npos);
  // Damaged Huffman tables (16 counts of 255 codes each) before and after the size and after other segments.
  const std::string head = "\xff\xd8"s, counts = "\xff\xc4\x00\x13\x10"s + std::string(16, '\xff');
  const std::string start = "\xff\xc0\0\x0b\x08\0\1\0\1\1\1\x11\0"s, other = "\xff\xfe\0\4ab"s;
  for (const std::string& bad :
       {head + counts, head + other + counts + start, head + start + counts,
        head + start + "\xff\xda\0\x08\1\1\0\0\x3f\0junk"s + counts, "\xff" + head + counts})
    CHECK(refusal(bad).find("damaged") != std::string::npos);
  // Within a comment they are not tables.
  std::string good = test::file_bytes(test::source_dir() / "tests/fuzz/corpus/image/plain.jpg");
  CHECK(refusal(good) == "");
  good.insert(2, "\xff\xfe\0\x17"s + counts);
  CHECK(refusal(good) == "");
  CHECK(refusal("GIF89a\1\0\1\0\0\0\0"s).find("not a picture in a supported format") != std::string::npos);
}
