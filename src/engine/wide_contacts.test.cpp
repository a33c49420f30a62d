#include "engine/wide_contacts.hpp"

#include <gtest/gtest.h>

#include <set>

#include "base/lane_records.hpp"

namespace phy::engine::group {
namespace {

/// Two rows of contacts between nine grains, some of them joints of two sets.
struct Rows {
  std::vector<ContactConst<double>> contacts;
  std::vector<std::int32_t> row_contact = {0, 4, 11};
  std::vector<double> geometry, state;
  GroupView<double> view;

  Rows() {
    const std::int32_t pairs[][3] = {{0, 1, -1}, {0, 2, 0},  {1, 2, -1}, {2, 3, -1}, {0, 4, 1}, {1, 4, -1},
                                     {2, 5, 0},  {4, 5, -1}, {3, 6, -1}, {5, 6, 1},  {6, 8, -1}};
    for (const auto& p : pairs) {
      const auto number = static_cast<double>(contacts.size());
      contacts.push_back({p[0], p[1], p[2], number, -number, 1.0, 0.1, 0.2, 0.3});
      geometry.push_back(10.0 + number);
      for (int f = 0; f < 3; ++f) state.push_back(100.0 * number + f);
    }
    view.n_rows = 2;
    view.row_contact = row_contact.data();
    view.contact_const = contacts.data(), view.geometry = geometry.data(), view.contact = state.data();
  }
};

/// The same in batches of W contacts.
struct Arranged : Rows {
  std::size_t W;
  WideContacts<double> wide;

  explicit Arranged(std::size_t lanes) : W(lanes), wide(lanes, 1, 3) {
    wide.arrange(view);
    wide.enter(view);
  }
};

TEST(WideContacts, EveryContactHasAPlaceAmongItsLike) {
  const Arranged rows(4);
  const std::size_t W = rows.W;
  const WideView<double>& w = rows.view.wide;
  std::set<std::int32_t> seen;
  for (int row = 0; row < 2; ++row) {
    const auto first = static_cast<std::size_t>(w.row_batch[row]) * W;
    for (std::int32_t c = rows.row_contact[static_cast<std::size_t>(row)];
         c < rows.row_contact[static_cast<std::size_t>(row) + 1]; ++c) {
      const std::size_t place = first + static_cast<std::size_t>(w.place[c]), batch = place / W,
                        lane = place % W;
      const ContactConst<double>& k = rows.contacts[static_cast<std::size_t>(c)];
      EXPECT_LT(batch, static_cast<std::size_t>(w.row_batch[row + 1]));
      EXPECT_TRUE(seen.insert(w.contact[place]).second);
      EXPECT_EQ(w.contact[place], c);
      EXPECT_EQ(w.joint[batch], k.joint);
      EXPECT_EQ(w.a[place], k.a);
      EXPECT_EQ(w.b[place], k.b);
      EXPECT_EQ(w.constants[(batch * (n_wide_constants + 1) + wide_Y) * W + lane], k.Y);
      EXPECT_EQ(w.constants[(batch * (n_wide_constants + 1) + n_wide_constants) * W + lane], 10.0 + c);
      EXPECT_EQ(w.state[(batch * 3 + 2) * W + lane], 100.0 * c + 2.0);
    }
  }
  EXPECT_EQ(seen.size(), rows.contacts.size());
}

// What the loop adds up: for each grain, the forces of its contacts in their
// order.
TEST(WideContacts, AGrainIsPushedInTheOrderOfItsContacts) {
  const Arranged rows(4);
  const WideView<double>& w = rows.view.wide;
  for (int row = 0; row < 2; ++row) {
    std::size_t n_pushes = 0;
    for (std::int32_t i = w.row_group[row]; i < w.row_group[row + 1]; ++i) {
      const PushedGrains& group = w.group[i];
      for (std::int32_t g = group.first; g < group.end; ++g) {
        std::vector<std::int32_t> expected;
        for (std::int32_t c = rows.row_contact[static_cast<std::size_t>(row)];
             c < rows.row_contact[static_cast<std::size_t>(row) + 1]; ++c) {
          const ContactConst<double>& k = rows.contacts[static_cast<std::size_t>(c)];
          if (k.a == w.pushed[g]) expected.push_back(w.place[c] * record_size);
          if (k.b == w.pushed[g]) expected.push_back(w.place[c] * record_size + record_size / 2);
        }
        const std::int32_t* first = w.pushes + group.first_push + (g - group.first) * group.n_pushes;
        EXPECT_EQ(std::vector<std::int32_t>(first, first + group.n_pushes), expected)
            << "grain " << w.pushed[g];
        n_pushes += expected.size();
      }
    }
    EXPECT_EQ(n_pushes, 2 * static_cast<std::size_t>(rows.row_contact[static_cast<std::size_t>(row) + 1] -
                                                     rows.row_contact[static_cast<std::size_t>(row)]));
  }
}

TEST(WideContacts, StatesComeBackToTheirContacts) {
  Arranged rows(8);
  const std::vector<double> before = rows.state;
  for (const std::size_t c : {0U, 4U, 10U}) {
    const std::size_t row = c < 4 ? 0 : 1;
    const std::size_t place = static_cast<std::size_t>(rows.view.wide.row_batch[row]) * 8 +
                              static_cast<std::size_t>(rows.view.wide.place[c]);
    rows.view.wide.state[(place / 8 * 3 + 1) * 8 + place % 8] = -1.0;
  }
  rows.wide.leave(rows.view);
  for (std::size_t c = 0; c < rows.contacts.size(); ++c)
    for (std::size_t f = 0; f < 3; ++f) {
      const bool changed = f == 1 && (c == 0 || c == 4 || c == 10);
      EXPECT_EQ(rows.state[c * 3 + f], changed ? -1.0 : before[c * 3 + f]);
    }
}

// What makes an empty place harmless: no state, and a gap that nothing closes.
TEST(WideContacts, EmptyPlacesNeverPress) {
  const Arranged rows(8);
  const std::size_t W = rows.W;
  const WideView<double>& w = rows.view.wide;
  const auto n_batches = static_cast<std::size_t>(w.row_batch[2]);
  std::size_t n_empty = 0;
  for (std::size_t p = 0; p < n_batches * W; ++p) {
    if (w.contact[p] >= 0) continue;
    ++n_empty;
    const std::size_t batch = p / W, lane = p % W;
    EXPECT_EQ(w.a[p], w.b[p]);
    EXPECT_GE(w.constants[(batch * (n_wide_constants + 1) + wide_gap) * W + lane], 1e3);
    for (std::size_t f = 0; f < 3; ++f) EXPECT_EQ(w.state[(batch * 3 + f) * W + lane], 0.0);
  }
  EXPECT_EQ(n_empty, n_batches * W - rows.contacts.size());
}

// A list that is renewed, rows without a contact, no contact at all.
TEST(WideContacts, AreLaidOutAnew) {
  Rows rows;
  WideContacts<double> wide(4, 1, 3), fresh(4, 1, 3);
  wide.arrange(rows.view);
  rows.row_contact = {0, 0, 7};
  rows.contacts.resize(7);
  for (WideContacts<double>* w : {&wide, &fresh}) {
    w->arrange(rows.view);
    w->enter(rows.view);
    EXPECT_EQ(rows.view.wide.row_batch[1], 0);
    EXPECT_EQ(rows.view.wide.row_group[1], 0);
    EXPECT_EQ(rows.view.wide.row_batch[2], 3) << "the matrix and two sets";
    EXPECT_EQ(rows.view.wide.most_places, 12U);
  }
  rows.row_contact = {0, 0, 0};
  wide.arrange(rows.view);
  wide.enter(rows.view);
  EXPECT_EQ(rows.view.wide.row_batch[2], 0);
  wide.leave(rows.view);
}

}  // namespace
}  // namespace phy::engine::group
