// SPDX-License-Identifier: Apache-2.0
#include "apps/server/hub.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace dismantle::server {

namespace {

constexpr int kMaxMalformed = 100;
/// Warnings that are kept for the first client that connects.
constexpr std::size_t kMaxUnheard = 8;
constexpr int kMaxDepth = 32;
/// A client that is disconnected for longer loses control.
constexpr std::chrono::seconds kControlTimeout{10};
/// A client that is disconnected for longer is forgotten.
constexpr std::chrono::minutes kClientTimeout{10};
/// Of more clients that are disconnected, those that left first are forgotten.
constexpr std::size_t kMaxAbsent = 256;
/// Commands that wait for the engine may take so much text; parsed, it is up to 50 times as much.
constexpr std::size_t kMaxPendingBytes = std::size_t{4} << 20;

SharedText shared(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

/// The error for a repeated command whose reply is no longer stored.
Error expired_reply() {
  return {ErrorKind::Failed,
          "the reply to this command is no longer stored (it was sent long ago); look at the "
          "state"};
}

/// True if JSON text is nested more deeply than any command: copying its value would exhaust the stack.
bool is_too_deep(std::string_view json) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (c == '"') in_string = !in_string;
    if (c == '\\' && in_string) ++i;
    if (in_string) continue;
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > kMaxDepth) return true;
  }
  return false;
}

Error too_many_pending() {
  return {ErrorKind::Failed, "the command was rejected (too many are pending); try again"};
}

}  // namespace

Hub::Hub(EngineLoop& engine, ServerCommands& commands, Post post)
    : engine_(engine), commands_(commands), post_(std::move(post)) {}

void Hub::set_hello(const Json& hello) {
  hello_ = shared(text_of(hello));
}

std::size_t Hub::client_count() const {
  return static_cast<std::size_t>(
      std::count_if(clients_.begin(), clients_.end(), [](const auto& c) { return c.second.socket != nullptr; }));
}

void Hub::connect(const std::string& key, ClientSocket& socket) {
  const auto [place, is_new] = clients_.try_emplace(key);
  Client& client = place->second;
  if (is_new) client.order = ++known_clients_;
  if (client.socket != nullptr) client.socket->close(CloseReason::Replaced);
  client.socket = &socket;
  client.malformed_messages = 0;
  forget_long_absent();
  if (controller_.empty()) controller_ = key;

  socket.send_text(hello_);
  send_control();
  if (model_) socket.send_text(model_);
  for (const auto& [job, text] : jobs_) socket.send_text(text);
  for (const SharedText& text : std::exchange(unheard_, {})) socket.send_text(text);
  // While something moves, the last state is outdated.
  engine_.request_state();
}

void Hub::disconnect(const std::string& key, ClientSocket& socket) {
  const auto found = clients_.find(key);
  if (found == clients_.end() || found->second.socket != &socket) return;
  found->second.socket = nullptr;
  found->second.disconnected_at = Clock::now();
  send_control();
}

void Hub::tick(Clock::time_point now) {
  const auto controller = clients_.find(controller_);
  if (controller != clients_.end() && controller->second.socket == nullptr &&
      now - controller->second.disconnected_at > kControlTimeout)
    give_control({});
  std::vector<std::string> expired;
  for (const auto& [key, client] : clients_)
    if (client.socket == nullptr && key != controller_ && now - client.disconnected_at > kClientTimeout)
      expired.push_back(key);
  for (const std::string& key : expired) forget(key);
}

void Hub::forget(const std::string& key) {
  replies_.forget(key);
  clients_.erase(key);
}

void Hub::forget_long_absent() {
  while (absent_count() > kMaxAbsent) {
    auto longest = clients_.end();
    for (auto at = clients_.begin(); at != clients_.end(); ++at) {
      if (at->second.socket != nullptr || at->first == controller_) continue;
      if (longest == clients_.end() || at->second.disconnected_at < longest->second.disconnected_at) longest = at;
    }
    if (longest == clients_.end()) return;
    forget(std::string(longest->first));
  }
}

bool Hub::give_control(const std::string& key) {
  if (!engine_.post([](Workbench& bench) { bench.stop_motion(); })) return false;
  controller_ = key;
  if (key.empty()) {  // to the client that has been known longest
    const Client* oldest = nullptr;
    for (const auto& [name, client] : clients_) {
      if (client.socket == nullptr || (oldest != nullptr && oldest->order < client.order)) continue;
      oldest = &client;
      controller_ = name;
    }
  }
  send_control();
  return true;
}

void Hub::send_control() {
  for (const auto& [key, client] : clients_) {
    if (client.socket == nullptr) continue;
    const Json json{{"event", "control"}, {"control", key == controller_}, {"clients", client_count()}};
    client.socket->send_text(shared(text_of(json)));
  }
}

Result<Json> Hub::take_control(const std::string& key) {
  const auto controller = clients_.find(controller_);
  const bool is_there = controller != clients_.end() && controller->second.socket != nullptr;
  if (key != controller_ && is_there && dragging_)
    return Error{ErrorKind::Usage,
                 "control cannot be taken (another page is dragging a component); wait until it is released"};
  if (key != controller_ && !give_control(key)) return too_many_pending();
  return Json::object();
}

void Hub::report_malformed(Client& client, const std::string& why) {
  if (client.socket == nullptr) return;
  ++client.malformed_messages;
  client.socket->send_text(shared(text_of(Json{{"event", "error"}, {"error", why}})));
  const bool is_dropped = client.socket == nullptr;  // it left too much unread
  if (!is_dropped && client.malformed_messages >= kMaxMalformed) client.socket->close(CloseReason::Malformed);
}

void Hub::receive_binary(const std::string& key, std::string_view bytes) {
  counters_.bytes_in += bytes.size();
  const auto found = clients_.find(key);
  if (found == clients_.end()) return;
  const auto message = decode_from_client(bytes);
  if (!message) {
    report_malformed(
        found->second,
        "a binary message was not understood (it is not a struct of docs/wire.md, or its values are invalid); "
        "correct the client");
  } else if (key == controller_) {
    engine_.set_input(*message);
  }
}

void Hub::receive_text(const std::string& key, std::string_view text) {
  counters_.bytes_in += text.size();
  const auto found = clients_.find(key);
  if (found == clients_.end()) return;
  const Json command = is_too_deep(text) ? Json() : Json::parse(text, nullptr, false);
  if (!command.is_object() || !command.contains("id") || !command["id"].is_number_unsigned() ||
      !command.contains("command") || !command["command"].is_string())
    return report_malformed(
        found->second,
        "a text message was not understood (it is not a JSON object with an id and a command); correct the client");
  receive_command(key, found->second, command, text.size());
}

void Hub::receive_command(const std::string& key, Client& client, const Json& command, std::size_t bytes) {
  const auto id = command["id"].get<std::uint64_t>();
  if (id > client.last_id) {
    client.last_id = id;
    return run_command(key, id, command, bytes);
  }
  // Repeated after a reconnect. A reply that is still pending goes to the new socket.
  const std::optional<SharedText> known = replies_.find(key, id);
  if (!known) return reply(key, id, expired_reply());
  if (*known) client.socket->send_text(*known);
}

void Hub::run_command(const std::string& key, std::uint64_t id, const Json& command, std::size_t bytes) {
  replies_.add_pending(key, id);

  const auto name = command["command"].get<std::string>();
  if (name == "take_control") return reply(key, id, take_control(key));
  const bool needs_control = commands_.knows(name) ? commands_.needs_control(name) : Workbench::needs_control(name);
  if (key != controller_ && needs_control)
    return reply(
        key, id,
        Error{ErrorKind::Usage, "'" + name + "' cannot be done (another page is in control); take control first"});
  if (commands_.knows(name)) return reply(key, id, commands_.execute(command));
  post_to_engine(key, id, command, bytes);
}

void Hub::post_to_engine(const std::string& key, std::uint64_t id, const Json& command, std::size_t bytes) {
  if (pending_bytes_ + bytes > kMaxPendingBytes) return reply(key, id, too_many_pending());
  const bool is_metrics = command["command"] == "metrics";
  const bool posted = engine_.post([this, key, id, command, bytes, is_metrics](Workbench& bench) {
    Result<Json> result = bench.execute(command);
    engine_.publish_state();  // the state precedes the reply
    post_([this, key, id, bytes, is_metrics, result = std::move(result)] {
      pending_bytes_ -= bytes;
      is_metrics&& result ? reply_metrics(key, id, *result) : reply(key, id, result);
    });
  });
  if (!posted) return reply(key, id, too_many_pending());
  pending_bytes_ += bytes;
}

void Hub::reply_metrics(const std::string& key, std::uint64_t id, Json json) {
  json["uptime"] = std::chrono::duration<double>(Clock::now() - started_).count();
  json["clients"] = client_count();
  json["pose_frames"] = counters_.pose_frames;
  json["dropped_frames"] = counters_.dropped_frames;
  json["bytes_in"] = counters_.bytes_in;
  json["bytes_out"] = counters_.bytes_out;
  json["refused"] = counters_.refused;
  json["absent_clients"] = absent_count();
  json["reply_bytes"] = replies_.bytes();
  reply(key, id, json);
}

void Hub::reply(const std::string& key, std::uint64_t id, const Result<Json>& result) {
  const auto found = clients_.find(key);
  if (found == clients_.end()) return;
  Json json{{"reply", id}, {"ok", result.ok()}};
  if (result) {
    json.update(*result);
  } else {
    json["error"] = result.error().message;
  }
  SharedText text = shared(text_of(json));
  replies_.set(key, id, text);
  if (found->second.socket != nullptr) found->second.socket->send_text(std::move(text));
}

void Hub::broadcast(const SharedText& event) {
  for (const auto& [key, client] : clients_)
    if (client.socket != nullptr) client.socket->send_text(event);
}

void Hub::broadcast_event(EngineEvent event) {
  const SharedText text = shared(std::move(event.text));
  if (event.kind == EngineEvent::Kind::Model) {
    model_ = text;
  } else if (event.kind == EngineEvent::Kind::State) {
    dragging_ = event.is_dragging;
  } else {
    keep_if_unheard(text);
  }
  broadcast(text);
}

void Hub::keep_if_unheard(const SharedText& text) {
  if (client_count() > 0) return;
  unheard_.push_back(text);
  if (unheard_.size() > kMaxUnheard) unheard_.pop_front();
}

void Hub::broadcast_job(std::uint32_t job, std::string text, bool running) {
  const SharedText event = shared(std::move(text));
  jobs_.erase(job);
  if (running) jobs_[job] = event;
  broadcast(event);
}

void Hub::broadcast_pose(std::string bytes) {
  ++counters_.pose_frames;
  const SharedText pose = shared(std::move(bytes));
  for (const auto& [key, client] : clients_)
    if (client.socket != nullptr) client.socket->send_pose(pose);
}

void Hub::close_all(CloseReason reason) {
  for (const auto& [key, client] : clients_)
    if (client.socket != nullptr) client.socket->close(reason);
}

}  // namespace dismantle::server
