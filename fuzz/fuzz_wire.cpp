// SPDX-License-Identifier: Apache-2.0
// The input from a client that is not JSON: binary frames, and the target of a request line.
#include "apps/server/access_rules.h"
#include "apps/server/url.h"
#include "apps/server/wire.h"
#include "fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dismantle;
  const std::string_view text = fuzz::text_of(data, size);
  if (const auto input = server::decode_from_client(text)) {
    const std::string bytes = std::visit([](const auto& message) { return server::encode(message); }, *input);
    fuzz::require(server::decode_from_client(bytes).has_value(), "what was decoded can be sent");
    fuzz::require(bytes.size() == size, "frames of one size");
  }
  if (const auto pose = server::decode_pose(text))
    fuzz::require(server::encode(*pose).size() == size, "a pose of the size that it says");
  if (const auto target = server::parse_target(text)) {
    fuzz::require(!target->path.empty() && target->path[0] == '/', "a path from the root");
    fuzz::require(target->path.find('\0') == std::string::npos, "no zero byte in a path");
  }
  const server::AccessRules rules(1234, std::string(32, 'a'));
  fuzz::require(!rules.is_authorized(text) || text == "Bearer " + std::string(32, 'a'), "only the token authorizes");
  rules.offers_token(text);
  fuzz::require(!rules.is_own_host(text) || text.ends_with(":1234"), "only our own hosts");
  return 0;
}
