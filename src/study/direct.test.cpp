// Studies by the direct elastic solution: every specimen is that solution, threads and shards do not matter,
// and lines over joint stiffnesses are held against those of others.
#include "study/direct.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/analyse.hpp"
#include "base/in_folder_fixture.hpp"
#include "genesis/specimen.hpp"
#include "study/effects.hpp"
#include "study/experiment.hpp"
#include "study/store_queue.hpp"
#include "study/study_in.hpp"
#include "study/table.hpp"
#include "study/worker.hpp"

namespace phy::study {
namespace {

using testing::HasSubstr;

class DirectStudy : public InFolder {
 protected:
  void SetUp() override {
    ::setenv("XDG_CACHE_HOME", at("cache").c_str(), 1);
    base("angles = [\"0 deg\", \"45 deg\", \"90 deg\"]\n");
    write(
        "lines.toml",
        "[[line]]\nsource = \"they\"\nnumber = \"K_n\"\nkey = \"bedding.k_n\"\nslope = 2\nintercept = \"-300 "
        "GPa/m\"\nR2 = 0.99\n");
  }
  void base(const std::string& test) const {
    write("base.toml",
          "[specimen]\nwidth = \"8 mm\"\nheight = \"16 mm\"\n[packing]\nn_grains = 340\n[[bedding]]\n"
          "spacing = \"2 mm\"\nrule = \"crossing\"\n[test]\nintact = true\n" +
              test);
  }
  Study study(const std::string& more = "") const {
    return read_study(write(
        "study.toml", "recipe = \"base.toml\"\nsolver = \"direct\"\nregressions = \"lines.toml\"\n" + more +
                          "[[vary]]\nkey = \"bedding.k_n\"\ntimes = [2, 0.5, 1]\n"
                          "[[vary]]\nkey = \"bedding.k_s\"\ntimes = [0.5, 1, 2]\n"));
  }
  static void work(const Plan& plan, Store& store, int threads = 2) {
    MachineOptions machine;
    machine.threads = threads;
    StoreQueue queue(plan, store, {}, threads);
    work_at(queue, plan, machine);
    EXPECT_EQ(queue.progress().n_failed, 0u);
  }
};

double number(const TestResult& r, const char* name) { return analysis::find(r.numbers, name)->value; }

TEST_F(DirectStudy, EverySpecimenIsItsDirectSolution) {
  const Plan plan = make_plan(study());
  ASSERT_EQ(plan.tests.size(), 5u * 3u + 1u);  // the base once, the intact rock once
  Store store(at("s.sqlite"));
  work(plan, store);
  const StudyRows rows = rows_of(plan, store);
  const auto packing = packing_of(plan.tests[0].recipe);
  for (std::size_t t = 0; t < rows.size(); t += 4) {
    const Recipe& r = plan.tests[t].recipe;
    const Specimen specimen = genesis::make_specimen(packing, r.matrix, r.bedding, "again");
    const TestResult& result = rows[t]->result;
    EXPECT_EQ(result.outcome.status, Status::solved);
    statics::ElasticOptions options;
    EXPECT_EQ(number(result, "E_gauge"), statics::solve_uniaxial(specimen, options).E_gauge);
    options.bilateral = true;
    const ElasticResult pulling = statics::solve_uniaxial(specimen, options);
    EXPECT_EQ(number(result, "E_platen_pulling"), pulling.E_platen);
    EXPECT_EQ(number(result, "nu_gauge_pulling"), pulling.nu_gauge);
  }
}

// A hole or flaw is part of the specimen that is solved.
TEST(DirectSolution, OfRockWithAnOpeningIsSofter) {
  Recipe r;
  r.specimen = {0.012, 0.024}, r.packing.n_grains = 742;
  const auto packing = packing_of(r);
  statics::UniaxialStatics statics;
  const auto E = [&] {
    const TestResult t = solve_directly(*specimen_of(packing, elastic_recipe(r)), statics);
    EXPECT_EQ(t.outcome.status, Status::solved) << t.outcome.reason;
    return number(t, "E_platen");
  };
  const double sound = E();
  r.specimen.flaw_length = 0.005;
  const double across = E();
  r.specimen.flaw_angle = 90.0;
  const double along = E();
  r.specimen.flaw_length = r.specimen.flaw_angle = 0.0, r.specimen.hole_diameter = 0.005;
  const double hole = E();
  EXPECT_LT(across, 0.95 * sound);
  EXPECT_LT(hole, 0.95 * sound);
  EXPECT_GT(along, across) << "a flaw along the load opens little";
  EXPECT_LT(along, sound);
}

// The seed of the bonds moves a modulus only where it says which contacts are joints.
TEST(ElasticRecipe, KeepsTheSeedThatDrawsTheBedding) {
  Recipe r;
  r.matrix.bond_seed = 5;
  r.bedding.resize(1);
  r.bedding[0].sigma_n_sd = 1e6;
  EXPECT_EQ(elastic_recipe(r).matrix.bond_seed, 1);
  for (const auto key : {&BeddingRecipe::spacing_sd, &BeddingRecipe::theta_sd, &BeddingRecipe::persistence}) {
    Recipe drawn = r;
    drawn.bedding[0].*key = 0.1;
    EXPECT_EQ(elastic_recipe(drawn).matrix.bond_seed, 5);
    drawn.bedding[0].rule = BeddingRule::oriented;
    EXPECT_EQ(elastic_recipe(drawn).matrix.bond_seed, 1);
  }
}

TEST_F(DirectStudy, SeveralBondSeedsOnlyWhereTheyDrawTheBedding) {
  const auto read = [&](const std::string& more) {
    return read_study(
        write("seeds.toml", "recipe = \"base.toml\"\nsolver = \"direct\"\nbond_seeds = [1, 2]\n" + more));
  };
  const std::string persistence = "[[vary]]\nkey = \"bedding.persistence\"\nvalues = [1, 0.5]\n";
  // 3 angles of the whole planes, 3 with bridges of each seed, and the intact rock.
  EXPECT_EQ(make_plan(read(persistence)).tests.size(), 3u + 2u * 3u + 1u);
  EXPECT_NO_THROW(read("[set]\n\"bedding.theta_sd\" = \"2 deg\"\n"));
  EXPECT_THROW(read("[[vary]]\nkey = \"bedding.k_n\"\ntimes = [1, 2]\n"), InputError);
}

TEST_F(DirectStudy, ThreadsAndShardsDoNotMatter) {
  const Plan plan = make_plan(study());
  Store one(at("one.sqlite")), four(at("four.sqlite"));
  work(plan, one, 1), work(plan, four, 4);
  for (int i = 1; i <= 2; ++i) {
    Store part(at("part" + std::to_string(i)), Sharing::alone);
    work(make_plan(study(), {i, 2}), part);
  }
  Store merged(at("merged.sqlite"));
  for (const char* part : {"part1", "part2"}) merged.merge(at(part));
  EXPECT_EQ(hash_of(rows_of(plan, one)), hash_of(rows_of(plan, four)));
  EXPECT_EQ(hash_of(rows_of(plan, one)), hash_of(rows_of(plan, merged)));
}

TEST_F(DirectStudy, KeysKnowTheSolverAndNotTheTest) {
  const Plan direct = make_plan(study());
  base(
      "angles = [\"0 deg\", \"45 deg\", \"90 deg\"]\nplaten_speed = \"0.2 m/s\"\n[engine]\nprecision = "
      "\"float\"\n");
  EXPECT_EQ(make_plan(study()).tests[0].key, direct.tests[0].key);
  Study in_time = study();
  in_time.solver = Solver::dynamic;
  EXPECT_NE(make_plan(in_time).tests[0].key, direct.tests[0].key);
}

TEST_F(DirectStudy, LinesAreLeastSquaresBesideThoseOfOthers) {
  const Plan plan = make_plan(study());
  Store store(at("s.sqlite"));
  work(plan, store);
  const StudyRows rows = rows_of(plan, store);
  const JointFits fits = fit_joints(plan, rows, {"E_gauge_pulling", theory::Eq1Reference::measured_90});
  const std::vector<std::size_t> points = curve_points(plan, 0);
  double K[3];
  for (std::size_t i = 0; i < 3; ++i) K[i] = fits.K_n.values[0][points[i]];
  EXPECT_LT(K[0], K[1]);
  EXPECT_LT(K[1], K[2]);
  // Three points at k, 2k, 4k: the least-squares slope is (-4 K0 - K1 + 5 K2)/(14 k).
  const double k = plan.points[points[0]].values[0], slope = (-4.0 * K[0] - K[1] + 5.0 * K[2]) / (14.0 * k);
  const std::vector<Effect> effects = effects_of(plan, fits.K_n, 0);
  EXPECT_NEAR(effects[0].value.mean, slope, 1e-9);
  EXPECT_TRUE(std::isnan(effects[0].value.half_width));  // one packing has no interval
  double overlap = 0.0;                                  // mean over the three angles
  for (std::size_t i = 0; i < 3; ++i)
    overlap += number(rows[plan.runs[i].test]->result, "overlap_ratio") / 3.0;
  EXPECT_NEAR(slope, overlap, 0.5 * overlap);
  const std::vector<Effect> beside = beside_regressions(plan, fits.K_n, 0, effects);
  ASSERT_EQ(beside.size(), 2u);
  EXPECT_NEAR(beside[0].value.mean, slope / 2.0, 1e-9);
  EXPECT_NEAR(beside[1].value.mean, (K[0] + K[1] + K[2]) / 3.0 - slope * 7.0 / 3.0 * k + 300e9, 1e3);
  EXPECT_TRUE(beside_regressions(plan, fits.K_s, 1, effects_of(plan, fits.K_s, 1)).empty());
  EXPECT_THAT(effects_text(plan, rows), HasSubstr("they: K_n = 2.0000 k_n + -300.0 GPa/m, R2 0.99000"));
  EXPECT_THAT(effects_csv(plan, all_responses(plan, rows)),
              HasSubstr("K_n,\"all angles, reference E(90)\",bedding.k_n,slope over that of they,1,1,"));
}

// Joints a thousand times softer than the rock: at 0 degrees springs k_n sum(A)/L, one per plane, in series.
TEST_F(DirectStudy, SoftJointsCarryAllTheStrainWithTheOverlapAsSlope) {
  const Study s = study(
      "[set]\n\"bedding.k_n\" = \"3.36 GPa/m\"\n\"bedding.k_s\" = \"0.96 GPa/m\"\n"
      "\"bedding.spacing\" = \"3 mm\"\n");
  const Plan plan = make_plan(s);
  Store store(at("s.sqlite"));
  work(plan, store);
  const TestResult result = rows_of(plan, store)[0]->result;
  const double n_planes = 5.0;  // of 16 mm, every 3 mm, one through the centre
  const double in_series = 3.36e9 * number(result, "overlap_ratio") * 0.016 / n_planes;
  EXPECT_NEAR(number(result, "E_platen_pulling"), in_series, 0.02 * in_series);
}

TEST_F(DirectStudy, IsCompleteAsFilesOfItsOwn) {
  const Study in = study();
  for (const auto& [name, content] : study_files(in)) write(name, content);
  const Study out = read_study(at("study.toml"));
  EXPECT_EQ(out.solver, Solver::direct);
  ASSERT_EQ(out.regressions.size(), 1u);
  EXPECT_EQ(out.regressions[0].intercept, -300e9);
  EXPECT_EQ(make_plan(out).tests[0].key, make_plan(in).tests[0].key);
}

TEST_F(DirectStudy, WhatHasNoEffectIsRefused) {
  EXPECT_THAT(message_of<InputError>([&] { study("bond_seeds = [1, 2]\n"); }),
              HasSubstr("study.toml:4: bond_seeds"));
  EXPECT_THAT(message_of<InputError>([&] {
                read_study(write("bad.toml",
                                 "recipe = \"base.toml\"\nsolver = \"dierct\"\nregressions = \"no.toml\"\n"));
              }),
              testing::AllOf(HasSubstr("bad.toml:2: solver"), HasSubstr("did you mean \"direct\"?"),
                             HasSubstr("bad.toml:3: regressions")));
}

}  // namespace
}  // namespace phy::study
