#include <fmt/format.h>
#include <gtest/gtest.h>
#include <cmath>
#include <chrono>
#include <map>
#include "lightproof/estimators/registry.h"
#include "lightproof/estimators/reduced_table.h"
#include "lightproof/image/synthetic.h"
#include "lightproof/recommend/prediction.h"
#include "lightproof/render/receiver.h"
#include "lightproof/study/exact_light.h"
#include "lightproof/warp/lat_long.h"
namespace lightproof { namespace {
EnvironmentMap random_map(Extent extent, double decades) {
  EnvironmentMap map{"random", Grid<Rgb>(extent)};
  const RandomStream stream("reduced table", 1);
  for (int y = 0; y < extent.height; ++y) for (int x = 0; x < extent.width; ++x) {
      const auto index = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(extent.width) + static_cast<std::uint64_t>(x);
      map.radiance(x, y) = Rgb(static_cast<float>(std::pow(10.0, decades * stream.point(index).s)));
  }
  return map;
}
TEST(Explore, All) {
  const ReceiverInfo& receiver = receiver_by_name("sphere");
  const Scene scene(receiver.content);
  auto pixels = visible_pixels(receiver, scene, {5, 4});
  std::vector<ShadingPoint> points; for (auto& p : pixels) points.push_back(p.point);
  const double np = static_cast<double>(points.size()); fmt::print("{} points\n", np);
  std::vector<EnvironmentMap> maps;
  for (auto n : {"constant","one-texel","gradient","step","sun-sky","checker"}) maps.push_back(make_synthetic_map(n, {320,160}));
  maps.push_back(random_map({320,160}, 3.0)); maps.back().name="random3";
  maps.push_back(random_map({320,160}, 0.5)); maps.back().name="random.5";
  std::vector<Grid<double>> lum; for (auto& m : maps) lum.push_back(luminance_of(m));
  std::vector<MapSummary> sums; for (auto& m : maps) sums.push_back(summarise(m));
  const char* only = getenv("MATS");
  std::vector<std::string> mats = {"lambert","phong:5","phong:50","phong:1000","ggx:0.1","ggx:0.3","ggx:0.8"};
  if (only) mats = {only};
  for (auto& mn : mats) {
    const Material material = material_of(mn);
    std::vector<std::string> names; std::vector<reference::CombinedSampling> samplings;
    for (auto& info : estimators()) if (info.combined) { names.emplace_back(info.name); samplings.push_back(*info.combined); }
    // [map][name] -> variance sum, and mean
    std::vector<std::map<std::string,double>> var(maps.size()); std::vector<double> mean(maps.size());
    for (auto& p : pixels) {
      auto kernel = kernel_at(receiver, scene, material, p.point);
      auto light = reference::light_moments(kernel, lum);
      auto comb = reference::combined_moments(kernel, lum, samplings);
      std::map<std::string,std::vector<reference::MeanAndVariance>> more;
      more["hemisphere"] = reference::density_moments(kernel, lum, [](Direction){return .5/kPi;});
      more["cosine"] = reference::density_moments(kernel, lum, [n=p.point.frame.normal](Direction d){return glm::dot(n,d)/kPi;});
      if (auto* g = std::get_if<Ggx>(&material)) for (auto [s, nm] : {std::pair{MicrofacetSampling::normals,"ggx normals"},{MicrofacetSampling::visible_normals,"ggx visible normals"}}) {
        Ggx o=*g; o.sampling=s; auto lm = reference::light_moments(kernel_at(receiver, scene, o, p.point), lum);
        for (auto& l : lm) more[nm].push_back({l[reference::SampledDensity::material].mean(), l[reference::SampledDensity::material].variance()});
      }
      for (std::size_t m = 0; m < maps.size(); ++m) {
        mean[m] += light[m][reference::SampledDensity::uniform].mean()/np;
        for (auto& info : estimators()) if (info.density && info.name.find("alias")==std::string_view::npos) var[m][std::string(info.name)] += light[m][*info.density].variance()/np;
        for (std::size_t i = 0; i < names.size(); ++i) var[m][names[i]] += comb[i][m].variance/np;
        for (auto& [k,v] : more) var[m][k] += v[m].variance/np;
        for (int f : {2,8}) {
          auto b = std::make_shared<BlockSums>(block_sums(maps[m], reduced_extent({320,160}, f)));
          double whole=0; for (double x : b->light.values()) whole+=x;
          auto mv = reference::density_moments(kernel, std::span(&lum[m],1), [b,whole](Direction d){ auto at=square_from_direction(d); int x=std::min(int(at.s*b->light.extent().width), b->light.extent().width-1); int y=std::min(int(at.t*b->light.extent().height), b->light.extent().height-1); return b->light(x,y)/b->solid_angle[y]/whole;});
          var[m][fmt::format("environment B alias 1/{}",f)] += mv[0].variance/np;
        }
      }
    }
    for (std::size_t m = 0; m < maps.size(); ++m) {
      auto pred = predict(sums[m], material, points);
      fmt::print("{:10} {:10} mean {:+.3f}% ", mn, maps[m].name, 100*(pred.mean/mean[m]-1));
      for (auto& [k,v] : var[m]) { auto* e = pred.find(k); if (!e||!e->error) { fmt::print(" {} MISSING", k); continue; }
        double exact = std::sqrt(v)/mean[m], got = std::sqrt(e->error->variance);
        double rel = 100*(got/exact-1);
        if (std::abs(rel) > 2 && std::max(exact,got) > 1e-3) fmt::print("| {} {:.3g} {:+.1f}% ", k, exact, rel); }
      fmt::print("\n");
    }
    fflush(stdout);
  }
}
}}
