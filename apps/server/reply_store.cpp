// SPDX-License-Identifier: Apache-2.0
#include "apps/server/reply_store.h"

#include <iterator>
#include <utility>

namespace dismantle::server {

void ReplyStore::add_pending(const std::string& client, std::uint64_t id) {
  auto& own = clients_[client];
  own[id] = entries_.insert(entries_.end(), {client, id, nullptr});
  bytes_ += kReplyOverhead;
  if (own.size() > limits_.client_replies) erase(own.begin()->second);
  while (bytes_ > limits_.total_bytes && entries_.size() > 1) erase(entries_.begin());
}

void ReplyStore::set(const std::string& client, std::uint64_t id, SharedText text) {
  const auto own = clients_.find(client);
  if (own == clients_.end()) return;
  const auto found = own->second.find(id);
  if (found == own->second.end() || found->second->text) return;
  bytes_ += text->size();
  found->second->text = std::move(text);
  while (bytes_ > limits_.total_bytes && entries_.size() > 1) erase(entries_.begin());
}

std::optional<SharedText> ReplyStore::find(const std::string& client, std::uint64_t id) const {
  const auto own = clients_.find(client);
  if (own == clients_.end()) return {};
  const auto found = own->second.find(id);
  if (found == own->second.end()) return {};
  return found->second->text;
}

void ReplyStore::forget(const std::string& client) {
  const auto own = clients_.find(client);
  if (own == clients_.end()) return;
  for (const auto& [id, place] : std::exchange(own->second, {})) {
    bytes_ -= kReplyOverhead + (place->text ? place->text->size() : 0);
    entries_.erase(place);
  }
  clients_.erase(own);
}

void ReplyStore::erase(Place place) {
  bytes_ -= kReplyOverhead + (place->text ? place->text->size() : 0);
  const auto own = clients_.find(place->client);
  own->second.erase(place->id);
  if (own->second.empty()) clients_.erase(own);
  entries_.erase(place);
}

}  // namespace dismantle::server
