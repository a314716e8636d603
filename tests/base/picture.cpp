#include "base/picture.h"

#include <doctest/doctest.h>

#include "base/error.h"

using namespace viete;

TEST_CASE("a_picture_comes_back_with_its_channels_or_those_asked_for") {
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
