#include <algorithm>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <glissade/apps/run/machine_check.h>

#include "glissade_program.h"
#include "temporary_folder.h"

namespace glissade::apps {
namespace {

using testing::HasSubstr;

/// A machine made of files.
class MachineCheck : public testing::Test {
 protected:
  void has(const std::string& file, const std::string& text) {
    std::filesystem::create_directories(std::filesystem::path(folder_.path(file)).parent_path());
    folder_.write(file, text + "\n");
  }

  Finding finding(const std::string& name) const {
    const std::vector<Finding> findings = check_machine(folder_.path(""));
    const auto found = std::find_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.name == name; });
    EXPECT_NE(found, findings.end()) << name;
    return found == findings.end() ? Finding{} : *found;
  }

 private:
  test_support::TemporaryFolder folder_;
};

TEST_F(MachineCheck, MissingSystemFilesGiveUnknown) {
  for (const char* name :
       {"real-time throttle", "frequency governor", "idle states", "clock source", "virtual machine"})
    EXPECT_EQ(finding(name).verdict, Verdict::kUnknown) << name;
}

TEST_F(MachineCheck, AGovernorThatSavesPowerCanBeBetterAndTheCommandIsTold) {
  has("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "powersave");
  EXPECT_EQ(finding("frequency governor").verdict, Verdict::kCanBeBetter);
  EXPECT_THAT(finding("frequency governor").mend, HasSubstr("cpupower frequency-set -g performance"));
  has("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance");
  EXPECT_EQ(finding("frequency governor").verdict, Verdict::kGood);
  EXPECT_EQ(finding("frequency governor").mend, "");
}

TEST_F(MachineCheck, TheDeepestIdleStateThatIsNotDisabledCounts) {
  const std::string states = "sys/devices/system/cpu/cpu0/cpuidle/state";
  has(states + "0/latency", "0");
  has(states + "1/latency", "2");
  has(states + "2/latency", "170");
  EXPECT_EQ(finding("idle states").verdict, Verdict::kCanBeBetter);
  EXPECT_EQ(finding("idle states").value, "up to 170 us");
  has(states + "2/disable", "1");
  EXPECT_EQ(finding("idle states").verdict, Verdict::kGood);
}

TEST_F(MachineCheck, RealTimeThrottleOf10PercentIsBad) {
  has("proc/sys/kernel/sched_rt_period_us", "1000000");
  has("proc/sys/kernel/sched_rt_runtime_us", "950000");
  EXPECT_EQ(finding("real-time throttle").verdict, Verdict::kGood);
  has("proc/sys/kernel/sched_rt_runtime_us", "-1");
  EXPECT_EQ(finding("real-time throttle").verdict, Verdict::kGood);
  has("proc/sys/kernel/sched_rt_runtime_us", "100000");
  EXPECT_EQ(finding("real-time throttle").verdict, Verdict::kBad);
}

TEST_F(MachineCheck, ARouteForTheGroupIsFound) {
  const std::string head = "Iface\tDestination\tGateway\tFlags\tRefCnt\tUse\tMetric\tMask\tMTU\tWindow\tIRTT\n";
  has("proc/net/route", head + "eth0\t0011AC0A\t00000000\t0001\t0\t0\t0\t00FFFFFF\t0\t0\t0");
  EXPECT_EQ(finding("multicast route").verdict, Verdict::kBad);
  has("proc/net/route", head + "lo\t000000EF\t00000000\t0001\t0\t0\t0\t000000FF\t0\t0\t0");
  EXPECT_EQ(finding("multicast route").verdict, Verdict::kGood);
  has("proc/net/route", head + "eth0\t00000000\t0111AC0A\t0003\t0\t0\t0\t00000000\t0\t0\t0");
  EXPECT_EQ(finding("multicast route").verdict, Verdict::kGood) << "the default route has every group";
}

TEST_F(MachineCheck, ARealTimeKernelIsGood) {
  has("proc/sys/kernel/osrelease", "6.1.0-rt");
  EXPECT_EQ(finding("kernel").verdict, Verdict::kCanBeBetter);
  has("sys/kernel/realtime", "1");
  EXPECT_EQ(finding("kernel").value, "6.1.0-rt, PREEMPT_RT");
  EXPECT_EQ(finding("kernel").verdict, Verdict::kGood);
}

TEST(MissingRights, SentenceNamesConsequenceAndRemedy) {
  EXPECT_EQ(missing_rights(true, true), "");
  const std::string both = missing_rights(false, false);
  EXPECT_THAT(both, HasSubstr("SCHED_FIFO is not granted: any busy program"));
  EXPECT_THAT(both, HasSubstr("memory is not locked: a page"));
  EXPECT_THAT(both, HasSubstr("limits.d/90-haptics.conf"));
  EXPECT_EQ(std::count(both.begin(), both.end(), '\n'), 0);
  EXPECT_THAT(missing_rights(true, false), testing::Not(HasSubstr("SCHED_FIFO")));
  EXPECT_THAT(missing_rights(false, true), testing::Not(HasSubstr("memory is not locked")));
}

TEST(Doctor, TellsEveryFindingAsTextAndAsJson) {
  const test_support::ProgramResult text = test_support::glissade({"doctor"});
  EXPECT_EQ(text.exit_code, 0);
  const test_support::ProgramResult result = test_support::glissade({"doctor", "--json"});
  EXPECT_EQ(result.exit_code, 0);
  const auto json = nlohmann::json::parse(result.standard_output);
  ASSERT_GE(json.size(), 10U);
  for (const auto& finding : json) {
    EXPECT_THAT(text.standard_output, HasSubstr(finding.at("name").get<std::string>() + ": "));
    EXPECT_NE(finding.at("meaning"), "");
    EXPECT_TRUE(finding.at("verdict") != "bad" || finding.at("mend") != "") << finding;
  }
}

}  // namespace
}  // namespace glissade::apps
