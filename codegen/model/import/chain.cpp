// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/model/import/chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "codegen/model/names.hpp"
#include "codegen/support/errors.hpp"
#include "codegen/support/visible_text.hpp"

namespace regulus::detail {
namespace {

using Joints = std::vector<const ImportedJoint*>;

/// The part up to the last joint that moves.
Joints moving_part(Joints joints) {
  while (!joints.empty() && !moves(*joints.back())) joints.pop_back();
  return joints;
}

class ChainFinder {
 public:
  ChainFinder(const Mechanism& mechanism, const std::string& file)
      : mechanism_(mechanism), file_(file) {
    for (const ImportedJoint& joint : mechanism.joints) {
      const auto [at, inserted] = parent_.emplace(joint.child, &joint);
      if (!inserted)
        refuse(joint.line,
               fmt::format("link {} is the child of two joints, {} and {}", in_quotes(joint.child),
                           in_quotes(at->second->name), in_quotes(joint.name)),
               "an arm has no loops; the manual page on robot files has the robots with loops that "
               "are read");
    }
  }

  Chain find(const std::string& base, const std::string& tip) const {
    Chain chain{base.empty() ? only_root() : known(base, "--base"), {}, {}};
    if (!tip.empty()) {
      chain.tip = known(tip, "--tip");
      chain.joints = path(chain.base, chain.tip);
      if (chain.tip != chain.base && chain.joints.empty())
        throw UsageError(
            fmt::format("--tip: no chain leads from {} to {}; --base must be a link "
                        "that carries the tip: {}",
                        in_quotes(chain.base), in_quotes(chain.tip), listed(carriers(chain.tip))));
    } else {
      choose_tip(chain);
    }
    require_single_motions(chain);
    require_no_loop(chain);
    return chain;
  }

 private:
  [[noreturn]] void refuse(int line, const std::string& problem, const std::string& remedy) const {
    throw InputError::statement(file_, line, problem, remedy);
  }

  static std::string listed(const std::vector<std::string>& links) {
    constexpr std::size_t kMost = 20;
    std::string text;
    for (std::size_t i = 0; i < links.size() && i < kMost; ++i)
      text += (i == 0 ? "" : ", ") + visible(links[i]);
    return links.size() > kMost ? text + fmt::format(" and {} more", links.size() - kMost) : text;
  }

  /// The links with the number of joints before them, the most first: an arm before its fingers.
  static std::string listed_with_joints(const std::vector<std::string>& links,
                                        const std::map<std::string, Joints>& ends) {
    const auto joints = [&ends](const std::string& link) {
      return std::ranges::count_if(ends.at(link), [](const ImportedJoint* j) { return moves(*j); });
    };
    std::vector<std::string> sorted = links;
    std::ranges::stable_sort(sorted, std::ranges::greater{}, joints);
    for (std::string& link : sorted) link += " (" + plural(joints(link), "joint") + ")";
    return listed(sorted);
  }

  const std::string& known(const std::string& link, const char* option) const {
    if (!mechanism_.has_link(link))
      throw UsageError(fmt::format(
          "{}: there is no link {}; {}", option, in_quotes(link),
          suggestion(link, mechanism_.links, "the links are " + listed(mechanism_.links))));
    return link;
  }

  std::string only_root() const {
    std::vector<std::string> roots;
    for (const std::string& link : mechanism_.links)
      if (!parent_.contains(link)) roots.push_back(link);
    // A link that nothing is attached to is no base, unless it is all there is.
    std::vector<std::string> used;
    for (const std::string& root : roots)
      if (std::ranges::any_of(mechanism_.joints,
                              [&](const ImportedJoint& j) { return j.parent == root; }))
        used.push_back(root);
    if (used.size() == 1) return used.front();
    if (mechanism_.joints.empty()) refuse(0, "the file has no joint", "an arm needs one");
    if (used.empty()) refuse(0, "every link has a parent", "an arm needs a base");
    throw UsageError("several links have no parent: " + listed(used) +
                     "; choose one with --base LINK");
  }

  /// From the base to the tip; empty if there is no way.
  Joints path(const std::string& base, const std::string& tip) const {
    Joints joints;
    std::set<std::string> seen;
    for (std::string link = tip; link != base;) {
      const auto at = parent_.find(link);
      if (at == parent_.end() || !seen.insert(link).second) return {};
      joints.push_back(at->second);
      link = at->second->parent;
    }
    std::ranges::reverse(joints);
    return joints;
  }

  std::vector<std::string> carriers(const std::string& tip) const {
    std::vector<std::string> links;
    std::set<std::string> seen;
    for (std::string link = tip; parent_.contains(link) && seen.insert(link).second;)
      links.push_back(link = parent_.at(link)->parent);
    return links;
  }

  /// Returns the first link behind all joints, among the links with the most joints before them.
  void choose_tip(Chain& chain) const {
    std::map<std::string, Joints> ends;  // by the last joint that moves
    for (const std::string& link : mechanism_.links) {
      const Joints joints = moving_part(path(chain.base, link));
      if (!joints.empty()) ends.emplace(joints.back()->child, joints);
    }
    std::set<std::string> passed;  // links with a joint that moves behind them
    for (const auto& [last, joints] : ends)
      for (const ImportedJoint* joint : joints)
        if (joint->child != last) passed.insert(joint->child);
    std::vector<std::string> tips;
    for (const std::string& link : mechanism_.links)
      if (ends.contains(link) && !passed.contains(link)) tips.push_back(link);
    leave_out_followers(tips, passed);
    if (tips.empty())
      refuse(0, "no joint moves a link that " + in_quotes(chain.base) + " carries",
             "choose another link with --base LINK");
    if (tips.size() > 1)
      throw UsageError(
          fmt::format("several links are the last of a chain of joints: {}; choose the "
                      "tip of the arm with --tip LINK, which may also be a link before "
                      "these{}; if the robot closes a loop there, give it with --cut LINK=LINK",
                      listed_with_joints(tips, ends), describe_fork(chain.base, tips)));
    chain.joints = ends.at(tips.front());
    chain.tip = tips.front();
  }

  /// Cylinders and springs follow a joint of the arm: they are no tips of it. A finger that follows
  /// the other finger is as good a tip as that.
  void leave_out_followers(std::vector<std::string>& tips,
                           const std::set<std::string>& passed) const {
    std::vector<std::string> others;
    for (const std::string& tip : tips) {
      const auto leader = std::ranges::find_if(mechanism_.joints, [&](const ImportedJoint& joint) {
        return joint.name == parent_.at(tip)->mimics;
      });
      const bool follows = leader != mechanism_.joints.end();
      if (!follows || !passed.contains(leader->child)) others.push_back(tip);
    }
    if (!others.empty()) tips = std::move(others);
  }

  /// The link behind which the chains to the tips part, with a joint that moves before it.
  std::string describe_fork(const std::string& base, const std::vector<std::string>& tips) const {
    Joints common = path(base, tips.front());
    for (const std::string& tip : tips) {
      const Joints other = path(base, tip);
      common.erase(std::ranges::mismatch(common, other).in1, common.end());
    }
    common = moving_part(common);
    return common.empty()
               ? ""
               : ", such as " + visible(common.back()->child) + ", behind which they part";
  }

  /// The joints that a loop connects have no independent speeds.
  void require_no_loop(const Chain& chain) const {
    for (const ImportedLoop& loop : mechanism_.loops) {
      const Joints first = path(chain.base, loop.first), second = path(chain.base, loop.second);
      const auto apart = std::ranges::mismatch(first, second);
      for (const ImportedJoint* joint : chain.joints) {
        const bool in_loop = std::find(apart.in1, first.end(), joint) != first.end() ||
                             std::find(apart.in2, second.end(), joint) != second.end();
        if (in_loop && moves(*joint))
          refuse(loop.line,
                 fmt::format("{} closes a loop of links {} and {} with joint {} of the arm",
                             in_quotes(loop.type), in_quotes(loop.first), in_quotes(loop.second),
                             in_quotes(joint->name)),
                 "choose --base and --tip outside the loop");
      }
    }
  }

  void require_single_motions(const Chain& chain) const {
    if (moving_part(chain.joints).empty())
      throw UsageError(
          fmt::format("no joint moves between {} and {}; choose other links with --base "
                      "and --tip",
                      in_quotes(chain.base), in_quotes(chain.tip)));
    for (const ImportedJoint* joint : chain.joints) {
      if (joint->type == JointType::kOther)
        refuse(
            joint->line,
            fmt::format("joint {} of the arm has the type {}", in_quotes(joint->name),
                        in_quotes(joint->type_name)),
            "an arm has revolute, continuous, prismatic and fixed joints; choose another --base");
      if (moves(*joint) && joint->mimics && !follows_a_leader(*joint, chain))
        refuse(joint->line,
               fmt::format("joint {} of the arm follows joint {} (mimic)", in_quotes(joint->name),
                           in_quotes(*joint->mimics)),
               "only a joint of the arm that follows none may be followed, with a multiplier and "
               "an offset; choose --base and --tip without it");
    }
  }

  static bool follows_a_leader(const ImportedJoint& follower, const Chain& chain) {
    return follower.rule && std::ranges::any_of(chain.joints, [&](const ImportedJoint* j) {
             return j->name == follower.mimics && moves(*j) && !j->mimics;
           });
  }

  const Mechanism& mechanism_;
  const std::string& file_;
  std::map<std::string, const ImportedJoint*> parent_;
};

}  // namespace

Chain find_chain(const Mechanism& mechanism, const std::string& file, const std::string& base,
                 const std::string& tip) {
  return ChainFinder(mechanism, file).find(base, tip);
}

}  // namespace regulus::detail
