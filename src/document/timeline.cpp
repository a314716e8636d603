#include "document/timeline.h"

#include <cmath>
#include <numbers>

namespace viete::document {

namespace {

// The frames and easings of keys. The easing of cameras is smooth.
struct Track {
  template <class Key>
  Track(const std::vector<Key>& keys, bool closes) : count(keys.size()), closed(closes) {
    for (const Key& key : keys) {
      frames.push_back(key.frame);
      if constexpr (requires { key.easing; }) easings.push_back(key.easing);
    }
  }
  double frame(std::size_t i) const { return frames[i]; }
  Easing easing(std::size_t i) const { return easings.empty() ? Easing::smooth : easings[i]; }

  std::size_t count;
  bool closed;  // the motion continues from the last key to the equal first key
  std::vector<int> frames;
  std::vector<Easing> easings;
};

// The interval from a key to the next key.
struct Piece {
  std::size_t from, to;
  double length;
  Easing easing;
};

std::optional<Piece> piece_after(const Track& track, std::size_t key) {
  if (key + 1 < track.count)
    return Piece{key, key + 1, track.frame(key + 1) - track.frame(key), track.easing(key)};
  return track.closed ? piece_after(track, 0) : std::nullopt;
}

std::optional<Piece> piece_before(const Track& track, std::size_t key) {
  if (key > 0) return piece_after(track, key - 1);
  return track.closed ? piece_after(track, track.count - 2) : std::nullopt;
}

// Adds to `shares`: factor * mean slope of the interval `piece`, per frame.
void add_secant(std::vector<KeyShare>& shares, const Piece& piece, double factor) {
  shares.push_back({piece.to, factor / piece.length});
  shares.push_back({piece.from, -factor / piece.length});
}

// Adds to `shares`: factor * slope of the spline at the key `key`, per frame.
void add_slope(std::vector<KeyShare>& shares, const Track& track, std::size_t key, double factor) {
  const auto before = piece_before(track, key), after = piece_after(track, key);
  if (!before || !after) return;
  for (const auto& [piece, other] : {std::pair(*before, *after), std::pair(*after, *before)})
    if (piece.easing == Easing::constant_speed) return add_secant(shares, piece, factor);
  if (before->easing != Easing::smooth || after->easing != Easing::smooth) return;
  const double whole = before->length + after->length;
  add_secant(shares, *before, factor * after->length / whole);
  add_secant(shares, *after, factor * before->length / whole);
}

// Replaces the shares of each key by their sum. Removes keys with factor 0.
void gather(std::vector<KeyShare>& shares) {
  std::vector<KeyShare> sum;
  for (const auto& [key, factor] : shares) {
    const auto found = std::ranges::find(sum, key, &KeyShare::key);
    if (found == sum.end()) {
      sum.push_back({key, factor});
    } else {
      found->factor += factor;
    }
  }
  std::erase_if(sum, [](const KeyShare& s) { return s.factor == 0; });
  shares = std::move(sum);
}

std::vector<KeyShare> hermite(const Track& track, std::size_t from, double t) {
  const double length = track.frame(from + 1) - track.frame(from);
  const double t2 = t * t, t3 = t2 * t;
  std::vector<KeyShare> shares{{from, 1 - 3 * t2 + 2 * t3}, {from + 1, 3 * t2 - 2 * t3}};
  add_slope(shares, track, from, length * (t - 2 * t2 + t3));
  add_slope(shares, track, from + 1, length * (t3 - t2));
  gather(shares);
  return shares;
}

std::vector<KeyShare> shares_in_piece(const Track& track, std::size_t from, double t) {
  const auto between = [from](double share) {
    return std::vector<KeyShare>{{from, 1 - share}, {from + 1, share}};
  };
  switch (track.easing(from)) {
    case Easing::hold: return {{from, 1}};
    case Easing::constant_speed: return between(t);
    case Easing::smooth: break;
  }
  return hermite(track, from, t);
}

Moment moment_on(const Track& track, double frame) {
  std::size_t next = 0;
  while (next < track.count && track.frame(next) <= frame) ++next;
  if (next == 0) return {{{0, 1}}, 0};
  const std::size_t from = next - 1;
  if (next == track.count || track.frame(from) == frame) return {{{from, 1}}, from};
  const double t = (frame - track.frame(from)) / (track.frame(next) - track.frame(from));
  return {shares_in_piece(track, from, t), from};
}

// True if the timeline loops and its last pose equals its first pose, except for whole turns.
bool is_closed(const Timeline& timeline) {
  const auto& keys = timeline.keys;
  if (timeline.repeat != Repeat::loop || keys.size() < 3) return false;
  const WholePose &first = *keys.front().pose, &last = *keys.back().pose;
  return &first == &last || (first.cage.positions == last.cage.positions && first.probes == last.probes &&
                             same_shape(first.shape, last.shape));
}

// True if the last camera equals the first camera, except for whole turns of the yaw. If the timeline does
// not loop, at least one whole turn is required.
bool comes_back(const Timeline& timeline) {
  constexpr double whole_turn = 2 * std::numbers::pi;
  const auto& cameras = timeline.cameras;
  if (cameras.size() < 3) return false;
  CameraPose first = cameras.front().camera;
  const CameraPose& last = cameras.back().camera;
  const double turns = (double(last.yaw) - first.yaw) / whole_turn;
  first.yaw = last.yaw;
  const bool whole = std::abs(turns - std::round(turns)) < 1e-5;
  return first == last && whole && (timeline.repeat == Repeat::loop || std::abs(turns) > 0.5);
}

}  // namespace

const Channel* channel_of(const Timeline& timeline, const std::string& name) {
  const auto found = std::ranges::find(timeline.channels, name, &Channel::name);
  return found == timeline.channels.end() ? nullptr : &*found;
}

double weight_at(const Timeline& timeline, const Channel& channel, double frame) {
  const auto& keys = channel.keys;
  const bool closed =
      timeline.repeat == Repeat::loop && keys.size() >= 3 && keys.front().weight == keys.back().weight;
  double weight = 0;
  for (const auto& [key, factor] : moment_on({keys, closed}, frame).shares)
    weight += factor * keys[key].weight;
  return weight;
}

double weight_at(const Timeline& timeline, const std::string& name, double frame) {
  const Channel* channel = channel_of(timeline, name);
  return channel ? weight_at(timeline, *channel, frame) : 0;
}

Moment moment_at(const Timeline& timeline, double frame) {
  return moment_on({timeline.keys, is_closed(timeline)}, frame);
}

std::optional<double> played(const Timeline& timeline, double frame, double seconds, bool& backward) {
  const double first = timeline.first, length = timeline.last - timeline.first;
  const double distance = (backward ? -1 : 1) * seconds * timeline.rate;
  const double place = std::clamp(frame - first, 0.0, length) + distance;
  if (!std::isfinite(place)) return std::nullopt;
  if (place >= 0 && place <= length) return first + place;
  if (timeline.repeat == Repeat::once) return std::nullopt;
  if (timeline.repeat == Repeat::loop) return first + place - length * std::floor(place / length);
  const double folded = place - 2 * length * std::floor(place / (2 * length));
  if (std::fmod(std::floor(place / length), 2) != 0) backward = !backward;
  return first + (folded > length ? 2 * length - folded : folded);
}

std::optional<CameraPose> camera_at(const Timeline& timeline, double frame) {
  if (timeline.cameras.empty()) return std::nullopt;
  const Moment moment = moment_on({timeline.cameras, comes_back(timeline)}, frame);
  CameraPose pose = timeline.cameras[moment.from].camera;
  glm::dvec3 target(0);
  double distance = 0, yaw = 0, pitch = 0;
  for (const auto& [key, factor] : moment.shares) {
    const CameraPose& c = timeline.cameras[key].camera;
    target += factor * glm::dvec3(c.target);
    distance += factor * std::log(static_cast<double>(c.distance));
    yaw += factor * c.yaw;
    pitch += factor * c.pitch;
  }
  pose.target = target;
  pose.distance = static_cast<float>(std::exp(distance));
  pose.yaw = static_cast<float>(yaw);
  pose.pitch = static_cast<float>(std::clamp(pitch, -std::numbers::pi / 2, std::numbers::pi / 2));
  return pose;
}

KeyPlaces key_places(const Timeline& timeline) {
  KeyPlaces places;
  for_each_track(timeline, [&](const auto& keys, const std::string& name) {
    for (const auto& key : keys) places.emplace_back(key.frame, name);
  });
  std::ranges::sort(places);
  places.erase(std::ranges::unique(places).begin(), places.end());
  return places;
}

std::vector<int> key_frames(const Timeline& timeline) {
  std::vector<int> frames;
  for (const KeyPlace& place : key_places(timeline)) frames.push_back(place.frame);
  frames.erase(std::ranges::unique(frames).begin(), frames.end());
  return frames;
}

}  // namespace viete::document
