#include "bench/comparison/limits.h"

namespace stadion::bench {
namespace {

using At = CostLimit::At;

CostLimit atSteps(int n, double ratio, const std::string& peers = "") {
  return {At::Steps, ratio, n, peers, 0};
}

const std::vector<MetricLimit> kThroughNoWall{{"tunnelled_of_8", 0}};
const std::vector<MetricLimit> kRebound{
    {"tunnelled_of_8", 0}, {"no_rebound_of_8", 0}, {"err", 1e-6}, {"vel_relerr", 1e-6}};
const std::vector<MetricLimit> kStands{{"fell", 0}};

const std::vector<CaseLimits>& table() {
  static const std::vector<CaseLimits> rows{
      {"C01", {{"err", 1e-11}}, {}, atSteps(1, 1. / 6), {}},
      {"C02", {{"err", 1e-8}}, {}, atSteps(1, 1. / 6), {}},
      {"C03",
       {{"ang_10s", 1e-5}, {"dE", 1e-6}, {"dL", 1e-13}},
       {{"ang_10s", 1e-10}},
       atSteps(1, 1. / 10, "mujoco-rk4"),
       {}},
      {"C04", {{"err", 1e-9}}, {}, atSteps(1, 1. / 3), {}},
      {"C05_bounce_e1.0",
       {{"err", 1e-9},
        {"time_err_max", 1e-10},
        {"apex1", 1e-9},
        {"apex3", 1e-9},
        {"apex5", 1e-9},
        {"apex10", 1e-9},
        {"apex20", 1e-9}},
       {},
       atSteps(1, 1. / 10),
       {{"err", 10}}},
      {"C05_bounce_e0.8",
       {{"err", 1e-9},
        {"time_err_max", 1e-10},
        {"apex1", 1e-9},
        {"apex3", 1e-9},
        {"apex5", 1e-9},
        {"apex10", 1e-9}},
       {},
       atSteps(1, 1. / 10),
       {{"err", 10}}},
      {"C05_bounce_e0.5",
       {{"err", 1e-9}, {"time_err_max", 1e-10}, {"apex1", 1e-9}, {"apex3", 1e-9}},
       {},
       atSteps(1, 1. / 10),
       {{"err", 10}}},
      {"C06", {{"err", 1e-6}, {"lateral", 1e-9}}, {}, atSteps(1, 1. / 2), {{"err", 10}}},
      // The direction's limit is a micrometre at the end of 0.9174 m.
      {"C07",
       {{"err", 1e-6},
        {"stop_dist_relerr", 1e-6},
        {"dir_err_deg", 6.2e-5},
        {"creep_10s", 0},
        {"slip_abserr", 1e-6}},
       {},
       atSteps(4, 1),
       {{"err", 1}}},
      {"C08", {{"err", 1e-4}, {"stable_tilt", 1e-12}}, {}, {At::EqualError, 1, 1, "", 0}, {{"err", 10}}},
      {"C09_tunnel", kRebound, {}, atSteps(1, 1. / 4, "bullet"), kThroughNoWall},
      // Stadion cannot switch off continuous detection, so its cost is compared with engines that switch it
      // on.
      {"C09_tunnel_v5_noccd", kRebound, {}, {}, {}},
      {"C09_tunnel_v10_noccd", kRebound, {}, {}, {}},
      {"C09_tunnel_v20_noccd", kRebound, {}, {}, {}},
      {"C09_tunnel_v50_noccd", kRebound, {}, {}, {}},
      {"C09_tunnel_v100_noccd", kRebound, {}, {}, {}},
      {"C09_tunnel_v200_noccd", kRebound, {}, {}, {}},
      {"C09_tunnel_v500_noccd", kRebound, {}, {}, {}},
      {"C09_tunnel_v1000_noccd", kRebound, {}, {}, {}},
      {"C09_disc",
       {{"tunnelled_of_8", 0}, {"pos_err", 1e-4}},
       {},
       atSteps(1, 1. / 4, "bullet"),
       kThroughNoWall},
      {"C10",
       {{"fell", 0}, {"top_sink", 1e-3}, {"max_pen", 1e-3}, {"drift", 1e-5}},
       {},
       atSteps(4, 1),
       kStands},
      {"C11_roll_plane", {{"err", 1e-9}}, {}, atSteps(1, 1. / 6), {{"err", 10}}},
      {"C11_roll_mesh", {{"vend_relerr", 1e-4}}, {}, atSteps(1, 1), {{"vend_relerr", 0.5}}},
      {"C12_cradle", {{"err", 1e-9}, {"E_err", 1e-10}, {"P_err", 1e-10}}, {}, atSteps(1, 1), {{"err", 10}}},
      {"C12_cluster",
       {{"err", 1e-10}, {"E_maxdev", 1e-10}, {"escaped", 0}},
       {},
       atSteps(1, 1),
       {{"escaped", 0}}},
      {"C13_degmesh", {{"bad_of_25", 0}}, {}, {}, {}},
      {"C13_far", {{"err", 1e-8}}, {}, {}, {}},
      {"C13_huge", {{"relerr", 1e-12}, {"relerr_ccd", 1e-12}}, {}, {}, {}},
      {"C13_hugehit", {{"tunnelled", 0}}, {}, {}, {}},
      {"C13_nan", {{"err", 0}}, {}, {}, {}},
      // Bodies that fall from 1 m reach 4.2 m/s; bodies that overlap must not gain speed.
      {"C13_coincident", {{"nonfinite", 0}, {"max_speed", 5}}, {}, {}, {}},
      {"C13_massratio", {{"top_sink", 1e-3}}, {}, {}, {}},
      {"C14",
       {{"escaped", 0}, {"max_pen", 10e-3}, {"pen_end", 1e-3}, {"E_rise_max", 1e-12}},
       {},
       {At::Steps, 0.5, 1, "bullet", 0.7},
       {{"escaped", 0}}},
      {"C15", {{"err", 1e-6}, {"ang_err", 1e-4}}, {}, atSteps(1, 0.12, "bullet"), {}},
  };
  return rows;
}

}  // namespace

const CaseLimits* limitsFor(const std::string& caseName) {
  const CaseLimits* best = nullptr;
  for (const CaseLimits& row : table())
    if (caseName.starts_with(row.name) && (!best || row.name.size() > best->name.size())) best = &row;
  return best;
}

}  // namespace stadion::bench
