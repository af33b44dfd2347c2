// SPDX-License-Identifier: Apache-2.0
/// Serialised samples over DDS, whichever vendor carries them: the two implementations are in
/// bridge/fastdds and bridge/cyclonedds. Nothing here or above knows a vendor's header, and nothing
/// below knows a message type.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "dds/security_files.hpp"

namespace clew::bridge {

/// What becomes of samples on the way. Between the components of a run it is as here; other values
/// are for endpoints that meet somebody else's.
struct Qos {
  bool reliable = true;
  bool transient_local = true;  ///< a late reader is given the last samples
  /// What a full history does: it refuses the write while a live reader lacks the oldest sample, or
  /// it drops that (KEEP_LAST), so that no reader ever holds up the writer.
  bool keep_last = false;
};

/// An endpoint's topic, its type, and how much of its past it keeps: history_depth samples. The
/// rest of the QoS is the same everywhere: XCDR1, keyless.
struct EndpointSpec {
  std::string topic;      ///< `scan`
  std::string type;       ///< `clew::msg::Scan`
  std::string user_data;  ///< USER_DATA, e.g. `clew_idl=<hex>;clew_stage=sense;`
  int history_depth = 1;
  Qos qos{};
};

/// An endpoint of somebody else, as discovery tells of it.
struct RemoteEndpoint {
  bool is_writer = false;
  std::string topic;
  std::string type;
  std::string user_data;
  std::string guid;    ///< 32 hexadecimal digits
  int process_id = 0;  ///< 0 where the vendor does not tell
  bool reliable = false;
  bool transient_local = false;  ///< or keeps its samples for longer
};

/// What a reader or a participant has to say. Calls come on the vendor's threads, and for what was
/// there before on the thread that creates the endpoint; samples of one reader never two at once,
/// and in order. Calls may write, and must not create or delete entities.
class SampleListener {
 public:
  virtual ~SampleListener() = default;
  /// A sample with its four bytes of encapsulation; valid during the call. `writer` is null while
  /// discovery has not told of it. Padding at the end, up to 3 bytes, may be present.
  virtual void on_sample(std::string_view cdr, const RemoteEndpoint* writer) = 0;
};

class DiscoveryListener {
 public:
  virtual ~DiscoveryListener() = default;
  /// The names of the participants that are known now; that of the own one may be among them.
  virtual void on_participants(const std::set<std::string>& names) = 0;
  /// A remote endpoint on a topic of ours matched one of our endpoints (the local one is a writer
  /// if the remote one is a reader).
  virtual void on_matched(const RemoteEndpoint& remote) = 0;
  /// It is gone: closed, or its lease ran out.
  virtual void on_unmatched(const RemoteEndpoint& remote) = 0;
  /// A remote endpoint and ours on `topic` do not match because of `policy` (`RELIABILITY`, ...).
  virtual void on_incompatible_qos(const std::string& topic, bool local_is_writer,
                                   const std::string& policy) = 0;
  /// A remote endpoint uses one of our topics with another type name.
  virtual void on_inconsistent_type(const RemoteEndpoint& remote) = 0;
  /// A remote endpoint is there, on any topic, or no longer: for who tells what there is.
  virtual void on_discovered(const RemoteEndpoint&) {}
  virtual void on_lost(const RemoteEndpoint&) {}
};

enum class WriteStatus : std::uint8_t {
  kTaken,       ///< in the history of the writer; it will arrive at every live reader
  kWouldBlock,  ///< not taken, a slow reader holds it up: try again, from another thread
  kFailed       ///< not taken, and it never will be
};

/// How long a writer that is closed waits at most until its readers have its last samples. A dead
/// reader is waited for, too, until its lease ends.
inline constexpr std::chrono::milliseconds kLinger{500};

class SampleWriter {
 public:
  /// Waits up to kLinger until live readers have the last samples.
  virtual ~SampleWriter() = default;
  /// Publishes the bytes, encapsulation included, without waiting for anybody.
  virtual WriteStatus write(std::string_view cdr) = 0;
  /// Whether every live reader has what was written; asks, and does not wait.
  virtual bool acknowledged() const = 0;
  /// As others see it in RemoteEndpoint::guid.
  virtual std::string guid() const = 0;
};

class SampleReader {
 public:
  virtual ~SampleReader() = default;
  /// As others see it in RemoteEndpoint::guid.
  virtual std::string guid() const = 0;
};

/// Where a participant of a run over several hosts speaks, by unicast: IPv4 addresses.
struct NetworkAddresses {
  std::string own;                 ///< of an interface of this host
  std::vector<std::string> peers;  ///< of all hosts of the run, this one among them
};

struct ParticipantConfig {
  int domain = 0;           ///< 0..99
  std::string name;         ///< for people: `sense`
  double lease_s;           ///< how long it is believed alive while it is silent
  std::string user_data{};  ///< USER_DATA of the participant, as `enclave=/;`
  /// Whether it speaks on every network of the host, with multicast, or on 127.0.0.1 only.
  bool on_network = false;
  /// With it, the participant takes part in a secured domain only; without, in an open one.
  std::optional<SecurityFiles> security{};
  /// With it, the participant speaks at that address instead of 127.0.0.1.
  std::optional<NetworkAddresses> hosts{};
};

/// A participant that speaks on 127.0.0.1 only, by unicast, and finds up to 100 others there,
/// unless it was told to speak on the network, or with the hosts of its run.
/// Destruction closes every endpoint; endpoints must be destroyed before.
class Participant {
 public:
  virtual ~Participant() = default;
  /// 32 hexadecimal digits, of which its endpoints' begin with the same 24.
  virtual std::string guid() const = 0;
  /// The listeners must outlive the endpoint.
  virtual core::Result<std::unique_ptr<SampleWriter>> create_writer(const EndpointSpec& spec) = 0;
  virtual core::Result<std::unique_ptr<SampleReader>> create_reader(const EndpointSpec& spec,
                                                                    SampleListener& listener) = 0;
};

}  // namespace clew::bridge
