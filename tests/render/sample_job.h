#pragma once
// A made-up job with everything a report can show: 80 m of curved tunnel in site coordinates of millions of metres.

#include "render/report.h"

namespace adit::tests {

/// Owns what a ReportContent points to.
struct SampleJob {
  Job job;
  Results results;
  DesignTunnel design;  ///< local frame
  DeviationMap map;
  MeshArrays mesh;
  render::ReportContent content;

  SampleJob();
  SampleJob(const SampleJob&) = delete;
  SampleJob& operator=(const SampleJob&) = delete;
};

/// Deviation of the made-up rock: look-out in rounds of 4 m, roughness, a tight spot near chainage 146 on the right.
double sample_deviation_m(double chainage_m, double p_m);

/// The made-up profile: straight walls and a half circle of radius 4 m, corners at the floor.
Profile sample_profile();

}  // namespace adit::tests
