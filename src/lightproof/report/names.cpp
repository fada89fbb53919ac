#include "lightproof/report/names.h"

#include <algorithm>
#include <cctype>

#include "lightproof/core/machine.h"
#include "lightproof/page/numbers.h"

namespace lightproof {
namespace {

std::string scene_stem(const RenderRecord& r) {
  return file_name_part(r.map) + "-" + file_name_part(r.receiver) + "-" +
         file_name_part(r.material);
}

bool same_scene(const RenderRecord& a, const RenderRecord& b) {
  return a.map == b.map && a.receiver == b.receiver && a.material == b.material;
}

std::string unused(const std::string& wanted, const std::vector<std::string>& taken) {
  std::string name = wanted;
  for (int n = 2; std::find(taken.begin(), taken.end(), name) != taken.end(); ++n) {
    name = wanted + "-" + std::to_string(n);
  }
  return name;
}

}  // namespace

std::string machine_words(double wall_per_cpu) {
  if (!(wall_per_cpu > kBusyRatio)) return "quiet";
  return "busy, " + format_number(wall_per_cpu, 2);
}

std::string file_name_part(std::string_view text) {
  std::string part;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
    part += plain || (c == '.' && !part.empty()) ? c : '_';
  }
  return part.empty() ? "_" : part;
}

std::vector<std::string> render_stems(const std::vector<RenderRecord>& renders) {
  std::vector<std::string> stems;
  for (const RenderRecord& r : renders) {
    stems.push_back(unused(scene_stem(r) + "-" + file_name_part(r.estimator), stems));
  }
  return stems;
}

std::vector<const RenderRecord*> members_of(const RenderScene& scene,
                                            const std::vector<RenderRecord>& renders) {
  std::vector<const RenderRecord*> members;
  for (const std::size_t i : scene.members) members.push_back(&renders[i]);
  return members;
}

std::vector<RenderScene> render_scenes(const std::vector<RenderRecord>& renders) {
  std::vector<RenderScene> scenes;
  std::vector<std::string> stems;
  for (std::size_t i = 0; i < renders.size(); ++i) {
    auto scene = std::find_if(scenes.begin(), scenes.end(), [&](const RenderScene& s) {
      return same_scene(renders[s.members.front()], renders[i]);
    });
    if (scene == scenes.end()) {
      stems.push_back(unused(scene_stem(renders[i]), stems));
      scene = scenes.insert(scenes.end(), RenderScene{stems.back(), {}});
    }
    scene->members.push_back(i);
  }
  return scenes;
}

}  // namespace lightproof
