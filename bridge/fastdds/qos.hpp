// SPDX-License-Identifier: Apache-2.0
/// The settings of Fast DDS, each with its reason where it is set.
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include "dds/participant.hpp"

namespace clew::bridge {

/// What holds for the whole process: no environment variable or file of the user's may widen the
/// network, log lines go to stderr, and two participants of one process talk over the network.
void prepare_fastdds_process();

eprosima::fastdds::dds::DomainParticipantQos fastdds_participant_qos(
    const ParticipantConfig& config);
eprosima::fastdds::dds::DataWriterQos fastdds_writer_qos(const EndpointSpec& spec);
eprosima::fastdds::dds::DataReaderQos fastdds_reader_qos(const EndpointSpec& spec);

}  // namespace clew::bridge
