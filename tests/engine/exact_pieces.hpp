// Motions of a system that is linear between the limits that it crosses: in closed form, by matrix
// exponentials, but for the instants of the crossings, which a bisection finds to rounding.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>
#include <vector>

namespace gearsweep::testing {

// x' = slope x + constant + cosine cos(w t) + sine sin(w t).
struct LinearField {
  Eigen::MatrixXd slope;
  Eigen::VectorXd constant, cosine, sine;

  explicit LinearField(Eigen::Index states)
      : slope(Eigen::MatrixXd::Zero(states, states)),
        constant(Eigen::VectorXd::Zero(states)),
        cosine(constant),
        sine(constant) {}
};

// A plane in the space of states; a state is beyond it where normal x > at.
struct Limit {
  Eigen::VectorXd normal;
  double at = 0.0;
};

// Which limits the motion is beyond.
using Sides = std::vector<bool>;

struct ExactPieces {
  double omega = 1.0;
  std::vector<Limit> limits;
  // The field, which is continuous at each limit; `spell` counts the spells of the period.
  std::function<LinearField(const Sides&, std::size_t)> field;
  // Shares of the period at which the field jumps, and 1.
  std::vector<double> spells = {1.0};

  struct Image {
    Eigen::VectorXd state;
    Eigen::MatrixXd monodromy;
    std::size_t crossings = 0;
  };

  double period() const { return 2.0 * std::numbers::pi / omega; }

  // One period from phase 0. Of 512 pieces, none may hold two crossings of the same limit.
  Image advance(const Eigen::VectorXd& start) const {
    const Eigen::Index n = start.size();
    const int pieces = 512;
    Eigen::VectorXd at(n + 3);  // the state, and 1, cos(w t), sin(w t), which also obey linear laws
    at << start, 1.0, 1.0, 0.0;
    Image image{start, Eigen::MatrixXd::Identity(n, n), 0};
    Sides sides = sides_of(at);
    double begin = 0.0;
    for (std::size_t spell = 0; spell < spells.size(); ++spell) {
      const double share = spells[spell] - begin;
      const int count = std::max(1, static_cast<int>(std::ceil(share * pieces)));
      const double piece = period() * share / count;
      std::map<Sides, Eigen::MatrixXd> whole;  // over a piece
      for (int i = 0; i < count; ++i) {
        double left = piece;
        while (left > 0.0) {
          const Eigen::MatrixXd law = whole_law(sides, spell, n);
          Eigen::MatrixXd& over_piece = whole[sides];
          if (over_piece.size() == 0) over_piece = (piece * law).exp();
          const auto over = [&](double time) -> Eigen::MatrixXd {
            return time == piece ? over_piece : (time * law).exp().eval();
          };
          double time = left;
          if (sides_of(over(left) * at) != sides) {
            double before = 0.0;
            for (double middle = 0.5 * left; before < middle && middle < time;
                 middle = 0.5 * (before + time)) {
              (sides_of(over(middle) * at) != sides ? time : before) = middle;
            }
          }
          const Eigen::MatrixXd through = over(time);
          at = through * at;
          image.monodromy = through.topLeftCorner(n, n) * image.monodromy;
          const Sides now = sides_of(at);
          if (now != sides) ++image.crossings;
          sides = now;
          left -= time;
        }
      }
      begin = spells[spell];
    }
    image.state = at.head(n);
    return image;
  }

  // The orbit of one period that Newton's method finds from `guess`; its state is at phase 0.
  Image orbit(const Eigen::VectorXd& guess) const {
    const Eigen::Index n = guess.size();
    Image image = advance(guess);
    Eigen::VectorXd state = guess;
    for (int i = 0; i < 8; ++i) {
      const Eigen::VectorXd change =
          (Eigen::MatrixXd::Identity(n, n) - image.monodromy).inverse() * (image.state - state);
      state += change;
      image = advance(state);
      if (change.norm() < 1e-13) break;
    }
    image.state = state;
    return image;
  }

 private:
  Sides sides_of(const Eigen::VectorXd& at) const {
    Sides sides;
    for (const Limit& limit : limits) {
      sides.push_back(limit.normal.dot(at.head(limit.normal.size())) > limit.at);
    }
    return sides;
  }

  Eigen::MatrixXd whole_law(const Sides& sides, std::size_t spell, Eigen::Index n) const {
    const LinearField one = field(sides, spell);
    Eigen::MatrixXd law = Eigen::MatrixXd::Zero(n + 3, n + 3);
    law.topLeftCorner(n, n) = one.slope;
    law.block(0, n, n, 1) = one.constant;
    law.block(0, n + 1, n, 1) = one.cosine;
    law.block(0, n + 2, n, 1) = one.sine;
    law(n + 1, n + 2) = -omega;
    law(n + 2, n + 1) = omega;
    return law;
  }
};

}  // namespace gearsweep::testing
