#include "spill_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace pelagos {

namespace {

const char* reason(SourceWait wait) {
  switch (wait) {
    case SourceWait::kNoWater:
      return "there is no water near it: move it, or lower it into the water";
    case SourceWait::kFull:
      return "as many particles are oil as oil.most_particles allows";
    case SourceWait::kOutside:
      return "its place is outside the patch, where its body has carried it";
    case SourceWait::kNone:
      break;
  }
  return "";
}

/// Keeps the entries whose name is still there.
template <class View, class Status>
void forget_gone(std::map<std::string, View>& views, const std::vector<Status>& present) {
  std::erase_if(views, [&](const auto& view) {
    return std::none_of(present.begin(), present.end(), [&](const Status& s) { return s.name == view.first; });
  });
}

}  // namespace

std::vector<CommandNews> SpillWatch::observe(const OilBudget& oil, double time) {
  std::vector<CommandNews> news;
  watch_sources(oil, news);
  watch_skimmers(oil, time, news);
  return news;
}

void SpillWatch::watch_sources(const OilBudget& oil, std::vector<CommandNews>& news) {
  const double lost = oil.held_back - held_back_;
  held_back_ = oil.held_back;
  for (const auto& [name, told] : told_waiting_) {
    const auto same = [&name = name](const SourceStatus& source) { return source.name == name; };
    if (std::any_of(oil.sources.begin(), oil.sources.end(), same)) continue;
    news.push_back({"release_ended", fmt::format("source \"{}\" has ended", name) +
                                         (lost > 0.0 ? fmt::format("; {:.4g} kg could not flow out", lost) : "")});
  }
  forget_gone(told_waiting_, oil.sources);
  for (const SourceStatus& source : oil.sources) {
    bool& told = told_waiting_[source.name];
    const bool waits = source.wait != SourceWait::kNone;
    if (!told && waits && source.waiting >= kPatience)
      news.push_back(
          {"release_waits", fmt::format("source \"{}\" has brought nothing out for {:g} s: {}; {:.4g} kg wait",
                                        source.name, kPatience, reason(source.wait), source.pending)});
    if (told && !waits) news.push_back({"release_flows", fmt::format("source \"{}\" flows again", source.name)});
    told = waits && (told || source.waiting >= kPatience);
  }
}

void SpillWatch::watch_skimmers(const OilBudget& oil, double time, std::vector<CommandNews>& news) {
  forget_gone(skimmers_, oil.skimmers);
  for (const SkimmerStatus& skimmer : oil.skimmers) {
    const auto [view, fresh] = skimmers_.try_emplace(skimmer.name);
    if (fresh) view->second.since = time;
    watch(skimmer, time, view->second, news);
  }
}

void SpillWatch::watch(const SkimmerStatus& skimmer, double time, SkimmerView& view, std::vector<CommandNews>& news) {
  if (skimmer.dry != view.dry) {
    view.dry = skimmer.dry;
    view.since = time;
  }
  if (time - view.since < kPatience || view.dry == view.told_dry) return;
  view.told_dry = view.dry;
  const double recovered = to_kilograms(skimmer.recovered);
  if (view.dry)
    news.push_back({"skimmer_dry", fmt::format("skimmer \"{}\" has been dry for {:g} s: no oil in its reach; it has "
                                               "recovered {:.4g} kg",
                                               skimmer.name, kPatience, recovered)});
  else if (skimmer.present_rate > 0.0)
    news.push_back({"skimmer_oil",
                    fmt::format("skimmer \"{}\" takes oil again, {:.3g} m^3/h", skimmer.name, skimmer.present_rate)});
}

}  // namespace pelagos
