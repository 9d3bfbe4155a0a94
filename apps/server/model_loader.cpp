// SPDX-License-Identifier: Apache-2.0
#include "apps/server/model_loader.h"

#include "dismantle/files/display_name.h"
#include "dismantle/files/text_name.h"
#include "dismantle/formats/gltf/write_glb.h"
#include "dismantle/loading/load_assembly.h"
#include "dismantle/session/step_limit.h"
#include "dismantle/simplify/simplify_assembly.h"
#include "dismantle/streams/choose_streams_backend.h"
#include "dismantle/surface/find_clashes.h"

#include <atomic>
#include <memory>
#include <mutex>

namespace dismantle::server {

namespace {

/// Reports the progress of making the session, from any thread. After finish() it neither reports nor cancels: the
/// session's engine keeps the callback.
class SessionProgress {
 public:
  explicit SessionProgress(const ProgressCallback& progress) : progress_(progress) {}
  bool keep_going() {
    if (finished_) return true;
    const std::lock_guard lock(mutex_);
    cancelled_ = cancelled_ || !report_progress(progress_, "preparing collision data", -1);
    return !cancelled_;
  }
  /// @return false if it was cancelled
  bool finish() {
    const bool going = keep_going();
    finished_ = true;
    return going;
  }

 private:
  const ProgressCallback& progress_;
  std::mutex mutex_;
  bool cancelled_ = false;
  std::atomic<bool> finished_ = false;
};

Result<Assembly> simplified(Assembly assembly, const ModelOptions& options, const ProgressCallback& progress) {
  if (options.simplify == 0) return assembly;
  SimplifyOptions simplify;
  simplify.executor = options.executor;
  simplify.progress = progress;
  Result<SimplifiedAssembly> result = simplify_assembly(assembly, options.simplify, simplify);
  if (!result) return result.error();
  return std::move(result->assembly);
}

/// Method `streams` for drags.
DragEngine streams_engine(const Assembly& assembly, const PairStates& states, const ModelOptions& options) {
  CollisionOptions collision;
  collision.executor = options.executor;
  ChosenStreamsBackend chosen = choose_streams_backend(assembly, collision, options.device);
  return {make_streams_motion_engine(assembly, states, collision, std::move(chosen.backend)), "streams", chosen.device,
          chosen.failure};
}

}  // namespace

Result<Model> load_model(const std::filesystem::path& file, const ModelOptions& options,
                         const ProgressCallback& progress) {
  ImportOptions import = options.import;
  import.progress = progress;
  Result<Assembly> read = load_assembly(file, import);
  if (!read) return read.error();
  Result<Assembly> ready = simplified(std::move(*read), options, progress);
  if (!ready) return ready.error();
  Model model;
  const auto assembly = std::make_shared<const Assembly>(std::move(*ready));
  model.assembly = assembly;
  model.name = clean_name(display_name(file));
  model.product = clean_name(product_name(file));

  const ClassifyOptions& classify = options.classify;
  Result<Clashes> clashes =
      find_clashes(*assembly, {classify.tolerance, classify.clearance, true, options.executor, progress});
  if (!clashes) return clashes.error();
  model.clashes = std::move(*clashes);
  if (!report_progress(progress, "preparing the picture", -1)) return Error{ErrorKind::Failed, "cancelled"};
  Result<std::string> glb = glb_from_assembly(*assembly);
  if (!glb) return glb.error();
  model.glb = std::make_shared<const std::string>(std::move(*glb));
  CertificateOptions engine;
  engine.executor = options.executor;
  limit_steps(engine);
  const auto watch = std::make_shared<SessionProgress>(progress);
  engine.keep_going = [watch] { return watch->keep_going(); };
  PairStates states = pair_states(model.clashes, classify.rule);
  std::error_code unused;
  if (options.declared_for.empty() || std::filesystem::equivalent(file, options.declared_for, unused)) {
    const Result<Done> declared = declare_allowances(states, *assembly, classify.declared);
    if (!declared) return declared.error();
  }
  if (watch->keep_going()) model.session = std::make_unique<Session>(*assembly, states, engine);
  if (options.drag_by_streams && watch->keep_going())
    model.session->set_drag_engine(streams_engine(*assembly, states, options));
  if (!watch->finish()) return Error{ErrorKind::Failed, "cancelled"};
  return model;
}

}  // namespace dismantle::server
