// SPDX-License-Identifier: Apache-2.0
#include "apps/server/wire.h"

#include "dismantle/core/contract.h"
#include "dismantle/files/byte_order.h"

#include <cmath>

namespace dismantle::server {

namespace {

constexpr std::uint8_t kTarget = 1, kRate = 2, kPose = 16;
constexpr double kUnitTolerance = 1e-6;

/// Encodes numbers, little-endian.
class Writer {
 public:
  template <class T>
  Writer& operator<<(T value) {
    const auto raw = little_endian_bytes(value);
    bytes_.append(raw.data(), raw.size());
    return *this;
  }
  template <class T>
  Writer& operator<<(const Vec3T<T>& v) {
    return *this << v.x << v.y << v.z;
  }
  Writer& operator<<(const Pose& p) {
    return *this << p.position << p.rotation.w << p.rotation.x << p.rotation.y << p.rotation.z;
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Decodes numbers, little-endian. The bytes must be long enough.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : at_(bytes.data()) {}
  template <class T>
  Reader& operator>>(T& value) {
    value = number_at<T>(at_, std::endian::little);
    at_ += sizeof(T);
    return *this;
  }
  template <class T>
  Reader& operator>>(Vec3T<T>& v) {
    return *this >> v.x >> v.y >> v.z;
  }
  Reader& operator>>(Pose& p) {
    return *this >> p.position >> p.rotation.w >> p.rotation.x >> p.rotation.y >> p.rotation.z;
  }

 private:
  const char* at_;
};

bool is_in_range(const Vec3& v) {
  return max_abs(v) <= kMaxWireNumber && std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Normalizes a quaternion; false if its length is too far from 1.
bool make_unit(Quat& q) {
  const double length = std::sqrt(dot(q, q));
  if (!(std::fabs(length - 1) <= kUnitTolerance)) return false;
  if (length != 1) q = normalized(q);
  return true;
}

/// Reads the header of a client's struct; false if a byte that must be 0 is not.
bool read_header(Reader& in, std::uint32_t& grip, std::uint32_t& number) {
  std::uint32_t type = 0, zero = 0;
  in >> type >> grip >> number >> zero;
  return type <= 0xff && zero == 0;
}

}  // namespace

std::string encode(const TargetMessage& m) {
  Writer out;
  out << std::uint32_t{kTarget} << m.grip << m.number << std::uint32_t{0} << m.pose;
  return out.take();
}

std::string encode(const RateMessage& m) {
  Writer out;
  out << std::uint32_t{kRate} << m.grip << m.number << std::uint32_t{0} << m.velocity << m.angular_velocity;
  return out.take();
}

std::string encode(const PoseMessage& m) {
  DISMANTLE_EXPECT(m.contacts.size() <= kMaxContacts);
  Writer out;
  out << kPose << m.flags << static_cast<std::uint16_t>(m.contacts.size()) << m.state << m.grip << m.answered << m.time
      << m.pose << m.clearance << m.step_us << m.steps_per_second;
  for (const ContactMessage& c : m.contacts)
    out << c.moving << c.fixed << c.face_moving << c.face_fixed << c.gap << 0.0f << c.point << c.normal;
  return out.take();
}

std::optional<DragInput> decode_from_client(std::string_view bytes) {
  if (bytes.empty()) return {};
  Reader in(bytes);
  if (bytes[0] == kTarget && bytes.size() == kTargetBytes) {
    TargetMessage m;
    if (!read_header(in, m.grip, m.number)) return {};
    in >> m.pose;
    if (!is_in_range(m.pose.position) || !make_unit(m.pose.rotation)) return {};
    return m;
  }
  if (bytes[0] == kRate && bytes.size() == kRateBytes) {
    RateMessage m;
    if (!read_header(in, m.grip, m.number)) return {};
    in >> m.velocity >> m.angular_velocity;
    if (!is_in_range(m.velocity) || !is_in_range(m.angular_velocity)) return {};
    return m;
  }
  return {};
}

std::optional<PoseMessage> decode_pose(std::string_view bytes) {
  if (bytes.size() < kPoseBytes || static_cast<std::uint8_t>(bytes[0]) != kPose) return {};
  Reader in(bytes);
  PoseMessage m;
  std::uint8_t type = 0;
  std::uint16_t count = 0;
  in >> type >> m.flags >> count >> m.state >> m.grip >> m.answered >> m.time >> m.pose >> m.clearance >> m.step_us >>
      m.steps_per_second;
  if (bytes.size() != kPoseBytes + count * kContactBytes) return {};
  m.contacts.resize(count);
  for (ContactMessage& c : m.contacts) {
    float zero = 0;
    in >> c.moving >> c.fixed >> c.face_moving >> c.face_fixed >> c.gap >> zero >> c.point >> c.normal;
  }
  return m;
}

}  // namespace dismantle::server
