#include "base/picture.h"

#include "base/error.h"
#include "support/data.h"
#include "support/folder.h"
#include "support/text.h"

using namespace viete;

TEST_CASE("pictures_are_read_back_and_incomplete_ones_refused") {
  const base::Picture picture{2, 1, {0, 50, 100, 255, 150, 200, 250, 128}};
  const base::Picture same = base::decode_picture("small", base::encode_png("small", picture));
  CHECK(same.width == 2);
  CHECK(same.height == 1);
  CHECK(same.rgba == picture.rgba);
  CHECK(same.pixel(1, 0)[2] == 250);
  CHECK_THROWS_AS(base::encode_png("small", {2, 2, picture.rgba}), base::Error);
}

TEST_CASE("pictures_of_hostile_size_are_refused_before_they_are_decoded") {
  using namespace std::string_literals;
  const auto refusal = [](const std::string& bytes) {
    return test::problem_of([&] { base::decode_picture("given", bytes); });
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
  // Tests damaged Huffman tables (16 counts of 255 codes each) at several positions in the file.
  const std::string head = "\xff\xd8"s, counts = "\xff\xc4\x00\x13\x10"s + std::string(16, '\xff');
  const std::string start = "\xff\xc0\0\x0b\x08\0\1\0\1\1\1\x11\0"s, other = "\xff\xfe\0\4ab"s;
  for (const std::string& bad :
       {head + counts, head + other + counts + start, head + start + counts,
        head + start + "\xff\xda\0\x08\1\1\0\0\x3f\0junk"s + counts, "\xff" + head + counts})
    CHECK(refusal(bad).find("damaged") != std::string::npos);
  // The same bytes in a comment of a valid JPEG do no harm.
  std::string good = test::file_bytes(test::source_dir() / "tests/fuzz/corpus/image/plain.jpg");
  CHECK(refusal(good) == "");
  good.insert(2, "\xff\xfe\0\x17"s + counts);
  CHECK(refusal(good) == "");
  CHECK(refusal("GIF89a\1\0\1\0\0\0\0"s).find("not a picture in a supported format") != std::string::npos);
}
