#include "sea_command.hpp"

#include <array>
#include <optional>
#include <utility>

#include "command_line/number_check.hpp"
#include "help_text.hpp"
#include "messages/limits.hpp"
#include "number_list.hpp"

namespace pelagos {
namespace {

using proto::v1::WaveSystem;

/// Of a swell that has come some way: narrower than a wind sea in frequency and direction (Goda 2010 has an exponent of
/// 25 at the peak after a short way of decay, and 75 after a long one).
constexpr double kSwellGamma = 5.0, kSwellSpreading = 25.0;

constexpr std::array<std::pair<const char*, WaveSystem::Spectrum>, 5> kSpectra{
    {{"jonswap", WaveSystem::JONSWAP},
     {"pm", WaveSystem::PIERSON_MOSKOWITZ},
     {"tma", WaveSystem::TMA},
     {"ochi-hubble", WaveSystem::OCHI_HUBBLE},
     {"regular", WaveSystem::REGULAR}}};

/// Options that describe the main system, and need it.
constexpr std::array kMainOptions{"--hs",     "--douglas",     "--beaufort",    "--tp",    "--tz",
                                  "--tm",     "--to",          "--spectrum",    "--gamma", "--shape",
                                  "--spread", "--spread-peak", "--long-crested"};

/// Three numbers with commas between them.
bool read_swell(const std::string& text, WaveSystem& out) {
  const auto numbers = read_numbers(text);
  if (!numbers || numbers->size() != 3) return false;
  out.set_height(numbers->at(0));
  out.set_peak_period(numbers->at(1));
  out.set_to_deg(numbers->at(2));
  out.set_gamma(kSwellGamma);
  out.set_spreading_at_peak(kSwellSpreading);
  return true;
}

}  // namespace

void SeaCommand::add_to(CLI::App& app) {
  sea = app.add_subcommand("sea", "Exchange the waves around the simulated water for those of a sea");
  sea->add_option("--hs", hs, help_with("Significant wave height, m", limits::kSeaHeight));
  sea->add_option("--tp", tp, help_with("Period of the spectrum's peak, s", limits::kSeaPeriod));
  sea->add_option("--tz", tz, help_with("Or the zero-crossing period Tm02, s", limits::kSeaPeriod));
  sea->add_option("--tm", tm, help_with("Or the mean period Tm01, s", limits::kSeaPeriod));
  sea->add_option("--douglas", douglas, help_with("A fully developed sea by Douglas degree", limits::kDouglas));
  sea->add_option("--beaufort", beaufort, help_with("A fully developed sea by Beaufort number", limits::kBeaufort));
  sea->add_option("--to", to,
                  help_with("Direction the waves run TOWARDS, degrees clockwise from north", limits::kWaveTo));
  sea->add_option("--spectrum", spectrum, "jonswap, pm, tma, ochi-hubble or regular (one wave of height HS)")
      ->check(OneOf({"jonswap", "pm", "tma", "ochi-hubble", "regular"}));
  sea->add_option("--gamma", gamma, help_with("Peak of jonswap and tma", limits::kGamma, "3.3"));
  sea->add_option("--shape", shape, help_with("lambda of ochi-hubble", limits::kShape));
  sea->add_option("--spread", spread,
                  help_with("Spreading s of cos^2s(theta/2), at all frequencies", limits::kSpreading));
  sea->add_option("--spread-peak", spread_at_peak,
                  help_with("The same by frequency, s at the peak", limits::kSpreading, "10"));
  sea->add_flag("--long-crested", long_crested, "All waves run in one direction");
  sea->add_option("--swell", swell, "HS,TP,TO of each swell beside the sea, or alone: m, s, degrees it runs TOWARDS");
  sea->add_flag("--wind-sea", wind_sea, "A sea that grows, turns and dies down with the wind");
  sea->add_option("--fetch", fetch, help_with("Of the wind sea: open water upwind, m", limits::kFetch, "300000"));
  sea->add_option(
      "--blown-for", blown_for,
      help_with("Of the wind sea: s that the wind has blown already (else the present one goes on, or it is "
                "as high as the fetch allows)",
                limits::kBlownFor));
  sea->add_option("--pace", pace,
                  help_with("Of the wind sea: how many times as fast as in nature", limits::kPaceOfSea, "1"));
  sea->add_option("--components", components, help_with("Wave components in all", limits::kSeaComponents, "100"));
  sea->add_option("--seed", seed, "Of phases and directions (else the scene's)");
  sea->add_option("--shortest", shortest, help_with("Leave out waves shorter than this, m", limits::kWaveLength));
  sea->add_option("--blend", blend, help_with("Change over so many seconds of simulated time", limits::kBlend, "0"));
  sea->add_flag("--off", off, "A flat sea");
}

bool SeaCommand::has_main_system() const { return given("--hs") || given("--douglas") || given("--beaufort"); }

std::string SeaCommand::usage_fault() const {
  if (!sea->parsed()) return "";
  const std::string help = "; see pelagos-ctl sea --help";
  if (off) {
    for (const CLI::Option* option : sea->get_options())
      if (option->count() > 0 && option->get_name() != "--off" && option->get_name() != "--blend" &&
          option->get_name() != "--at")
        return "sea: --off is given beside " + option->get_name() + "; allowed: --blend and --at" + help;
    return "";
  }
  if (const std::string fault = fault_of_wind_sea(); !fault.empty()) return fault + help;
  if (has_main_system()) return "";
  for (const char* option : kMainOptions)
    if (given(option))
      return std::string("sea: ") + option +
             " is given without a height; required: --hs, --douglas or "
             "--beaufort" +
             help;
  if (!swell.empty() || wind_sea) return "";
  return "sea: say which, e.g. --hs 2 --tp 7 --to 250 --blend 60, or --beaufort 6 --to 90, or --wind-sea, or --off" +
         help;
}

std::string SeaCommand::fault_of_wind_sea() const {
  if (wind_sea) return "";
  for (const char* option : {"--fetch", "--blown-for", "--pace"})
    if (given(option)) return std::string("sea: ") + option + " is given without --wind-sea";
  return "";
}

void SeaCommand::fill_wind_sea(proto::v1::WindSea& out) const {
  if (given("--fetch")) out.set_fetch(fetch);
  if (given("--blown-for")) out.set_blown_for(blown_for);
  if (given("--pace")) out.set_pace(pace);
}

void SeaCommand::fill_main_system(WaveSystem& out) const {
  for (const auto& [name, value] : kSpectra)
    if (spectrum == name) out.set_spectrum(value);
  if (given("--hs")) out.set_height(hs);
  if (given("--tp")) out.set_peak_period(tp);
  if (given("--tz")) out.set_zero_crossing_period(tz);
  if (given("--tm")) out.set_mean_period(tm);
  if (given("--douglas")) out.set_douglas(douglas);
  if (given("--beaufort")) out.set_beaufort(beaufort);
  if (given("--to")) out.set_to_deg(to);
  if (given("--spread")) out.set_spreading(spread);
  if (given("--spread-peak")) out.set_spreading_at_peak(spread_at_peak);
  if (long_crested) out.set_long_crested(true);
  if (given("--gamma")) out.set_gamma(gamma);
  if (given("--shape")) out.set_shape(shape);
}

std::string SeaCommand::fill(proto::v1::TimedCommand& out) const {
  if (off) {
    out.mutable_set_waves()->set_flat(true);
    if (given("--blend")) out.mutable_set_waves()->set_blend(blend);
    return "";
  }
  proto::v1::SetSea& set = *out.mutable_set_sea();
  if (has_main_system()) fill_main_system(*set.add_system());
  if (wind_sea) fill_wind_sea(*set.mutable_wind_sea());
  for (const std::string& text : swell)
    if (!read_swell(text, *set.add_system()))
      return "sea: --swell " + text + " is no swell; allowed: HS,TP,TO, e.g. 1.5,12,300";
  if (given("--components")) set.set_components(components);
  if (given("--seed")) set.set_seed(seed);
  if (given("--shortest")) set.set_shortest_length(shortest);
  if (given("--blend")) set.set_blend(blend);
  return "";
}

}  // namespace pelagos
