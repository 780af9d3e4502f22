#pragma once
/// A run that is going on, heard on the bus.

#include <memory>
#include <string>
#include <vector>

#include "common/bus/sessions/listener.hpp"
#include "monitor/recording/recording.hpp"
#include "monitor/source.hpp"

namespace fsi::monitor {

class Live : public Source {
 public:
  /// @param record file for everything that is heard; empty: none
  Live(RunEntry run, const std::string& record);

  void listen(RunState& state, double seconds) override;
  /// True when every program that is there has been heard.
  bool heard_everybody(const RunState& state) const;
  double now() const override;
  void watch(const std::vector<std::string>& wishes) override { listener_.watch(wishes); }
  std::vector<wire::Picture> pictures() override { return listener_.pictures(); }
  std::string request(Request request) override;
  std::string controls() const override { return "p pause  r resume  c checkpoint  s stop  "; }

 private:
  void look_at_processes(RunState& state);
  /// Why a run is over whose Abort never came: its summary says so.
  void learn_the_end(RunState& state);

  RunEntry run_;
  bus::Listener listener_;
  std::unique_ptr<Recorder> recorder_;
  std::string host_;
  double looked_at_ = 0;  ///< [s]
  bool table_read_ = false;
};

/// What the system says about a process of this machine.
Process process_state(int pid);

}  // namespace fsi::monitor
