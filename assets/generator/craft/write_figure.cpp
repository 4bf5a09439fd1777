#include "assets/generator/craft/glb_writer.h"

namespace stadion::assets {
namespace {

using glb::text;

// Bones have our axes; the roots turn them into the file's.

Pose rootPose(const Pose& rest) {
  const double h = std::sqrt(0.5);
  return {{rest.p.x(), rest.p.z(), -rest.p.y()}, Quat(h, -h, 0, 0) * rest.q};
}

std::string turnText(const Quat& q) {
  return text("[%.7g,%.7g,%.7g,%.7g]", q.x() + 0.0, q.y() + 0.0, q.z() + 0.0, q.w() + 0.0);
}

std::string placeText(const Vec3& p) {
  return text("[%.7g,%.7g,%.7g]", p.x() + 0.0, p.y() + 0.0, p.z() + 0.0);
}

void putPlace(std::string& out, const Vec3& p) {
  for (const double v : {p.x(), p.y(), p.z()}) glb::putFloat(out, v);
}

void putTurn(std::string& out, const Quat& q) {
  for (const double v : {q.x(), q.y(), q.z(), q.w()}) glb::putFloat(out, v);
}

/// The inverse of the bind pose: from the file's axes to the bone's.
void putBind(std::string& out, const Pose& X_WB) {
  const Pose X = X_WB.inverse();
  const Vec3 axes[] = {Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitY()};  // the file's, in ours
  for (const Vec3& axis : axes) putPlace(out, X.q * axis), glb::putFloat(out, 0);
  putPlace(out, X.p), glb::putFloat(out, 1);
}

std::vector<Pose> inModel(const std::vector<BoneModel>& bones) {
  std::vector<Pose> all;
  for (const BoneModel& b : bones)
    all.push_back(b.parent < 0 ? b.rest : all[static_cast<std::size_t>(b.parent)] * b.rest);
  return all;
}

/// One bone's poses of a clip, and which of them are written.
class BoneKeys {
public:
  BoneKeys(const ClipModel& clip, std::size_t bone) : times_(clip.times) {
    for (const auto& poses : clip.poses) {
      Pose pose = poses[bone];
      if (!poses_.empty() && pose.q.dot(poses_.back().q) < 0) pose.q.coeffs() = -pose.q.coeffs();
      poses_.push_back(pose);
    }
  }

  double farthest(const Vec3& from) const {
    double most = 0;
    for (const Pose& pose : poses_) most = std::max(most, (pose.p - from).norm());
    return most;
  }
  double widest(const Quat& from) const {
    double most = 0;
    for (const Pose& pose : poses_) most = std::max(most, off(from, pose.q));
    return most;
  }

  std::vector<std::size_t> places(double error) const {
    return thinned([&](std::size_t a, std::size_t b, std::size_t i) {
      const Vec3 guess = poses_[a].p + share(a, b, i) * (poses_[b].p - poses_[a].p);
      return (guess - poses_[i].p).norm() <= error;
    });
  }
  std::vector<std::size_t> turns(double error) const {
    return thinned([&](std::size_t a, std::size_t b, std::size_t i) {
      return off(det::slerp(poses_[a].q, poses_[b].q, share(a, b, i)), poses_[i].q) <= error;
    });
  }

  const Pose& pose(std::size_t i) const { return poses_[i]; }

private:
  static double off(const Quat& a, const Quat& b) { return det::logRotation(a.conjugate() * b).norm(); }
  double share(std::size_t a, std::size_t b, std::size_t i) const {
    return (times_[i] - times_[a]) / (times_[b] - times_[a]);
  }

  template <class Fits>
  std::vector<std::size_t> thinned(const Fits& fits) const {
    std::vector<std::size_t> kept{0};
    if (still()) return kept;
    for (std::size_t at = 0; at + 1 < times_.size();) {
      std::size_t next = at + 1;
      const auto all = [&](std::size_t end) {
        for (std::size_t i = at + 1; i < end; ++i)
          if (!fits(at, end, i)) return false;
        return true;
      };
      while (next + 1 < times_.size() && all(next + 1)) ++next;
      kept.push_back(at = next);
    }
    return kept;
  }
  bool still() const { return farthest(poses_.front().p) < 1e-5 && widest(poses_.front().q) < 1e-4; }

  const std::vector<double>& times_;
  std::vector<Pose> poses_;
};

class FigureWriter {
public:
  FigureWriter(const FigureModel& model, double place_error, double turn_error)
      : model_(model), place_error_(place_error), turn_error_(turn_error) {}

  std::string write() {
    writer_.keepClipsTogether();
    const bool narrow = model_.bones.size() <= 256;
    for (const SkinnedPart& part : model_.parts)
      if (!part.part.triangles.empty()) writer_.add(part, narrow);
    const std::string skin = skinText();
    std::vector<std::string> clips;
    for (const ClipModel& clip : model_.clips) clips.push_back(clipText(clip));
    return writer_.take(nodesText(), ",\n\"skins\":[" + skin + "],\n\"animations\":" + glb::joined(clips) +
                                         ",\n\"extensionsUsed\":[\"KHR_mesh_quantization\"],"
                                         "\"extensionsRequired\":[\"KHR_mesh_quantization\"]");
  }

private:
  // The mesh is node 0, the bones follow.

  std::string nodesText() const {
    std::vector<std::string> nodes{"{\"name\":\"body\",\"mesh\":0,\"skin\":0}"};
    std::string roots = "0";
    for (std::size_t i = 0; i < model_.bones.size(); ++i) {
      const BoneModel& bone = model_.bones[i];
      if (bone.parent < 0) roots += text(",%zu", i + 1);
      std::string children;
      for (std::size_t k = i + 1; k < model_.bones.size(); ++k)
        if (model_.bones[k].parent == static_cast<int>(i))
          children += text(children.empty() ? "%zu" : ",%zu", k + 1);
      const Pose rest = bone.parent < 0 ? rootPose(bone.rest) : bone.rest;
      nodes.push_back("{\"name\":\"" + bone.name + "\",\"translation\":" + placeText(rest.p) +
                      ",\"rotation\":" + turnText(rest.q) +
                      (children.empty() ? "}" : ",\"children\":[" + children + "]}"));
    }
    return "\"scenes\":[{\"nodes\":[" + roots + "]}],\n\"nodes\":" + glb::joined(nodes);
  }

  std::string skinText() {
    std::string binds, joints;
    const std::vector<Pose> rest = inModel(model_.bones);
    for (std::size_t i = 0; i < rest.size(); ++i) {
      putBind(binds, rest[i]);
      joints += text(i == 0 ? "%zu" : ",%zu", i + 1);
    }
    const int matrices = writer_.accessor(binds, 0, rest.size(), 5126, "MAT4", "");
    return text("{\"name\":\"skeleton\",\"inverseBindMatrices\":%d,\"joints\":[", matrices) + joints + "]}";
  }

  std::string clipText(const ClipModel& clip) {
    samplers_.clear();
    std::vector<std::string> channels;
    for (std::size_t bone = 0; bone < model_.bones.size(); ++bone) {
      const BoneKeys keys(clip, bone);
      const Pose& rest = model_.bones[bone].rest;
      const auto channel = [&](const std::vector<std::size_t>& kept, bool turns) {
        channels.push_back(text("{\"sampler\":%zu,\"target\":{\"node\":%zu,\"path\":\"%s\"}}",
                                samplers_.size(), bone + 1, turns ? "rotation" : "translation"));
        addSampler(clip, keys, kept, turns);
      };
      // The clip is as long as its longest channel: that of the first bone.
      if (bone == 0 || keys.farthest(rest.p) > 1e-6)
        channel(bone == 0 ? std::vector<std::size_t>{0, clip.times.size() - 1} : keys.places(place_error_),
                false);
      if (keys.widest(rest.q) > 1e-6) channel(keys.turns(turn_error_), true);
    }
    return "{\"name\":\"" + clip.name + "\",\"samplers\":" + glb::joined(samplers_) +
           ",\"channels\":" + glb::joined(channels) + "}";
  }

  void addSampler(const ClipModel& clip, const BoneKeys& keys, const std::vector<std::size_t>& kept,
                  bool turns) {
    std::string times, values;
    for (const std::size_t i : kept) {
      glb::putFloat(times, clip.times[i]);
      turns ? putTurn(values, keys.pose(i).q) : putPlace(values, keys.pose(i).p);
    }
    const int input = writer_.clipAccessor(
        times, kept.size(), "SCALAR",
        text(",\"min\":[%.9g],\"max\":[%.9g]", clip.times[kept.front()], clip.times[kept.back()]));
    const int output = writer_.clipAccessor(values, kept.size(), turns ? "VEC4" : "VEC3", "");
    samplers_.push_back(text("{\"input\":%d,\"output\":%d}", input, output));
  }

  const FigureModel& model_;
  double place_error_, turn_error_;
  GlbWriter writer_;
  std::vector<std::string> samplers_;
};

}  // namespace

std::string toGlb(const FigureModel& model, double place_error, double turn_error) {
  return FigureWriter(model, place_error, turn_error).write();
}

}  // namespace stadion::assets
