#include "face_section.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <utility>

namespace pelagos {

namespace {

constexpr std::size_t kStop = 32;  ///< steps that a place where a slab begins costs at least

/// A segment that is not vertical; `own` is 1 or -1 at the edges of the face itself.
struct Line {
  Eigen::Vector2d from, to;
  int own = 0, above = 0, below = 0;
  std::uint32_t shell = 0;
  int repeat = 0;

  [[nodiscard]] double at(double x) const {
    return from.y() + (to.y() - from.y()) * ((x - from.x()) / (to.x() - from.x()));
  }
  [[nodiscard]] double lowest() const { return std::min(from.y(), to.y()); }
  [[nodiscard]] double highest() const { return std::max(from.y(), to.y()); }
};

/// Winding numbers on the way up through the outlines.
class WindingSums {
 public:
  explicit WindingSums(const std::vector<SectionShell>& shells) : shells_(&shells), jump_(shells.size(), 0) {}

  void cross(const Line& line, int sign) {
    own_ += sign * line.own;
    repeats_ += sign * line.repeat;
    if (line.own != 0 || line.repeat != 0) return;
    above_ += sign * line.above;
    below_ += sign * line.below;
    const SectionShell& shell = (*shells_)[line.shell];
    if (shell.outward) {
      solid_above_ += sign * line.above;
      solid_below_ += sign * line.below;
    }
    if (!shell.first) return;
    repeats_ -= jump_[line.shell] > 0 ? 1 : 0;
    jump_[line.shell] += sign * (line.below - line.above);
    repeats_ += jump_[line.shell] > 0 ? 1 : 0;
  }
  [[nodiscard]] bool on_face() const { return own_ > 0; }
  [[nodiscard]] FaceSurroundings here() const { return {above_, below_, solid_above_, solid_below_, repeats_ > 0}; }

 private:
  const std::vector<SectionShell>* shells_;
  std::vector<int> jump_;  ///< below less above, of shells that come first
  int own_ = 0, above_ = 0, below_ = 0, solid_above_ = 0, solid_below_ = 0, repeats_ = 0;
};

class FaceSweep {
 public:
  FaceSweep(const std::array<Eigen::Vector2d, 3>& corners, OwnWinding own, const std::vector<OutlineSegment>& segments,
            const std::vector<SectionShell>& shells, double tiny, std::size_t& work)
      : own_(own), tiny_(tiny), work_(work), jumps_(shells.size()), base_(shells) {
    for (const Eigen::Vector2d& corner : corners) range_.extend(corner);
    for (std::size_t c = 0; c < 3; ++c) add_edge(corners[c], corners[(c + 1) % 3]);
    for (const OutlineSegment& segment : segments) add_outline(segment);
    std::stable_sort(lines_.begin(), lines_.end(),
                     [](const Line& a, const Line& b) { return a.from.x() < b.from.x(); });
  }

  FaceRemainder run() {
    find_stops();
    for (std::size_t s = 1; s < stops_.size() && !out_of_work(); ++s)
      if (stops_[s] - stops_[s - 1] > tiny_) sweep_slab(stops_[s - 1], stops_[s]);
    for (const OpenPiece& piece : open_) emit(piece);
    result_.complete = !out_of_work();
    return std::move(result_);
  }

 private:
  /// A trapezoid between two lines that may go on in the next slab.
  struct OpenPiece {
    std::size_t lower = 0, upper = 0;  ///< index into the lines
    double begin = 0.0, end = 0.0;     ///< x
  };

  [[nodiscard]] bool out_of_work() const { return work_ == 0; }
  void spend(std::size_t steps) { work_ -= std::min(work_, steps); }

  void add_edge(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    if (from.x() < to.x()) lines_.push_back({from, to, 1});
    if (from.x() > to.x()) lines_.push_back({to, from, -1});
  }

  void add_outline(const OutlineSegment& segment) {
    if (segment.to.x() <= range_.min().x() || segment.from.x() >= range_.max().x()) return;
    const Line line{segment.from, segment.to, 0, segment.above, segment.below, segment.shell, segment.repeat};
    if (line.lowest() >= range_.max().y()) return;
    if (line.from.x() == line.to.x()) {
      if (line.highest() >= range_.min().y()) stops_.push_back(line.from.x());
      return;
    }
    (line.highest() < range_.min().y() ? under_ : lines_).push_back(line);
  }

  /// The x at which slabs begin and end: ends of lines, and where they cross.
  void find_stops() {
    const double low = range_.min().x(), high = range_.max().x();
    stops_.insert(stops_.end(), {low, high});
    const auto add = [&](double x) {
      if (!(x > low && x < high)) return;
      stops_.push_back(x);
      spend(kStop);
    };
    for (std::size_t i = 0; i < lines_.size() && !out_of_work(); ++i) {
      const Line& a = lines_[i];
      add(a.from.x());
      add(a.to.x());
      std::size_t j = i + 1;
      for (; j < lines_.size() && lines_[j].from.x() < std::min(a.to.x(), high); ++j)
        if (a.lowest() <= lines_[j].highest() && lines_[j].lowest() <= a.highest()) add(crossing(a, lines_[j]));
      spend(j - i);
    }
    std::sort(stops_.begin(), stops_.end());
  }

  /// x, or a value out of range.
  [[nodiscard]] double crossing(const Line& a, const Line& b) const {
    const double begin = std::max(a.from.x(), b.from.x()), end = std::min(a.to.x(), b.to.x());
    const double first = a.at(begin) - b.at(begin), last = a.at(end) - b.at(end);
    if (!(first * last < 0.0)) return range_.min().x();
    return begin + (end - begin) * (first / (first - last));
  }

  /// Brings the active lines, and the sums of those under the face, to the slab around x.
  void activate(double x) {
    for (; next_line_ < lines_.size() && lines_[next_line_].from.x() <= x; ++next_line_) active_.push_back(next_line_);
    std::erase_if(active_, [&](std::size_t n) { return lines_[n].to.x() <= x; });
    if (by_begin_.empty() && !under_.empty()) sort_under();
    for (; begun_ < under_.size() && under_[by_begin_[begun_]].from.x() <= x; ++begun_)
      base_.cross(under_[by_begin_[begun_]], 1);
    for (; ended_ < under_.size() && under_[by_end_[ended_]].to.x() <= x; ++ended_)
      base_.cross(under_[by_end_[ended_]], -1);
  }

  void sort_under() {
    by_begin_.resize(under_.size());
    std::iota(by_begin_.begin(), by_begin_.end(), std::size_t{0});
    by_end_ = by_begin_;
    std::stable_sort(by_begin_.begin(), by_begin_.end(),
                     [&](std::size_t a, std::size_t b) { return under_[a].from.x() < under_[b].from.x(); });
    std::stable_sort(by_end_.begin(), by_end_.end(),
                     [&](std::size_t a, std::size_t b) { return under_[a].to.x() < under_[b].to.x(); });
  }

  void sweep_slab(double begin, double end) {
    const double middle = 0.5 * (begin + end);
    activate(middle);
    spend(8 + 4 * active_.size() + jumps_ / 4);
    heights_.clear();
    for (const std::size_t n : active_) heights_.emplace_back(lines_[n].at(middle), n);
    std::sort(heights_.begin(), heights_.end());
    WindingSums sums = base_;
    kept_.clear();
    bool running = false;
    for (std::size_t k = 0; k + 1 < heights_.size(); ++k) {
      sums.cross(lines_[heights_[k].second], 1);
      const double gap = heights_[k + 1].first - heights_[k].first;
      if (!(gap > tiny_)) continue;
      const bool keep = sums.on_face() && count(sums.here(), gap * (end - begin));
      if (keep && !running) kept_.push_back({heights_[k].second, 0, begin, end});
      if (keep) kept_.back().upper = heights_[k + 1].second;
      running = keep;
    }
    go_on(begin);
  }

  /// Adds to the areas; whether the place is kept.
  bool count(const FaceSurroundings& here, double area) {
    const bool free_above = here.above + own_.above <= 0, solid_below = here.below + own_.below >= 1;
    const bool keep = free_above && solid_below && !here.repeated;
    FaceAreas& areas = result_.areas;
    areas.all += area;
    if (keep) areas.kept += area;
    if (here.below >= 1) areas.backed += area;
    if (here.below >= 1 && here.above >= 1) areas.buried += area;
    if (here.solid_above < 1) areas.bare += area;
    if (free_above && !solid_below) areas.joining += area;
    if (free_above && !solid_below && here.solid_below < 1) areas.opening += area;
    if (here.above != 0 || here.below != 0) areas.enclosed += area;
    return keep;
  }

  /// Joins what is kept in this slab to what was kept between the same lines in the slab before.
  void go_on(double begin) {
    for (OpenPiece& piece : kept_) {
      const auto same = std::find_if(open_.begin(), open_.end(), [&](const OpenPiece& before) {
        return before.lower == piece.lower && before.upper == piece.upper && begin - before.end <= tiny_;
      });
      if (same == open_.end()) continue;
      piece.begin = same->begin;
      open_.erase(same);
    }
    for (const OpenPiece& piece : open_) emit(piece);
    open_ = kept_;
  }

  void emit(const OpenPiece& piece) {
    const Line &lower = lines_[piece.lower], &upper = lines_[piece.upper];
    result_.pieces.push_back(
        {Eigen::Vector2d(piece.begin, lower.at(piece.begin)), Eigen::Vector2d(piece.end, lower.at(piece.end)),
         Eigen::Vector2d(piece.end, upper.at(piece.end)), Eigen::Vector2d(piece.begin, upper.at(piece.begin))});
    spend(8);
  }

  OwnWinding own_;
  double tiny_;
  std::size_t& work_;
  std::size_t jumps_;  ///< number of shells: what a copy of the sums costs
  Eigen::AlignedBox2d range_;
  std::vector<Line> lines_, under_;  ///< under_: below all of the face, only their sum matters
  std::vector<std::size_t> by_begin_, by_end_;
  std::vector<double> stops_;
  std::size_t next_line_ = 0, begun_ = 0, ended_ = 0;
  std::vector<std::size_t> active_;
  std::vector<std::pair<double, std::size_t>> heights_;
  WindingSums base_;
  std::vector<OpenPiece> open_, kept_;
  FaceRemainder result_;
};

}  // namespace

FaceRemainder cut_face(const std::array<Eigen::Vector2d, 3>& corners, OwnWinding own,
                       const std::vector<OutlineSegment>& segments, const std::vector<SectionShell>& shells,
                       double tiny, std::size_t& work) {
  return FaceSweep(corners, own, segments, shells, tiny, work).run();
}

}  // namespace pelagos
