// One step of the embedded Runge-Kutta method of Dormand and Prince of order 8(5,3), known as DOP853.
// Coefficients: Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, 2nd ed., Springer 1993, section
// II.5; tests/geodesic/dop853_test.cpp checks them against the order conditions.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace geovor::dop853 {

inline constexpr int kStages = 12;

/// The error of one step falls as h^9, and so does its estimate: a step that is to meet an error follows from the last
/// one by this power.
inline constexpr double kErrorOrder = 9.0;

/// Row i: the weights of stages 0..i-1 in stage i.
inline constexpr double kA[kStages][kStages] = {
    {},
    {5.26001519587677318785587544488e-2},
    {1.97250569845378994544595329183e-2, 5.91751709536136983633785987549e-2},
    {2.95875854768068491816892993775e-2, 0, 8.87627564304205475450678981324e-2},
    {2.41365134159266685502369798665e-1, 0, -8.84549479328286085344864962717e-1, 9.24834003261792003115737966543e-1},
    {3.7037037037037037037037037037e-2, 0, 0, 1.70828608729473871279604482173e-1, 1.25467687566822425016691814123e-1},
    {3.7109375e-2, 0, 0, 1.70252211019544039314978060272e-1, 6.02165389804559606850219397283e-2, -1.7578125e-2},
    {3.70920001185047927108779319836e-2, 0, 0, 1.70383925712239993810214054705e-1, 1.07262030446373284651809199168e-1,
     -1.53194377486244017527936158236e-2, 8.27378916381402288758473766002e-3},
    {6.24110958716075717114429577812e-1, 0, 0, -3.36089262944694129406857109825e0, -8.68219346841726006818189891453e-1,
     2.75920996994467083049415600797e1, 2.01540675504778934086186788979e1, -4.34898841810699588477366255144e1},
    {4.77662536438264365890433908527e-1, 0, 0, -2.48811461997166764192642586468e0, -5.90290826836842996371446475743e-1,
     2.12300514481811942347288949897e1, 1.52792336328824235832596922938e1, -3.32882109689848629194453265587e1,
     -2.03312017085086261358222928593e-2},
    {-9.3714243008598732571704021658e-1, 0, 0, 5.18637242884406370830023853209e0, 1.09143734899672957818500254654e0,
     -8.14978701074692612513997267357e0, -1.85200656599969598641566180701e1, 2.27394870993505042818970056734e1,
     2.49360555267965238987089396762e0, -3.0467644718982195003823669022e0},
    {2.27331014751653820792359768449e0, 0, 0, -1.05344954667372501984066689879e1, -2.00087205822486249909675718444e0,
     -1.79589318631187989172765950534e1, 2.79488845294199600508499808837e1, -2.85899827713502369474065508674e0,
     -8.87285693353062954433549289258e0, 1.23605671757943030647266201528e1, 6.43392746015763530355970484046e-1}};

/// Weights of the solution of order 8.
inline constexpr double kB[kStages] = {5.42937341165687622380535766363e-2,
                                       0,
                                       0,
                                       0,
                                       0,
                                       4.45031289275240888144113950566e0,
                                       1.89151789931450038304281599044e0,
                                       -5.8012039600105847814672114227e0,
                                       3.1116436695781989440891606237e-1,
                                       -1.52160949662516078556178806805e-1,
                                       2.01365400804030348374776537501e-1,
                                       4.47106157277725905176885569043e-2};

/// Weights of the difference to the embedded solution of order 5.
inline constexpr double kError5[kStages] = {0.1312004499419488073250102996e-01,
                                            0,
                                            0,
                                            0,
                                            0,
                                            -0.1225156446376204440720569753e+01,
                                            -0.4957589496572501915214079952e+00,
                                            0.1664377182454986536961530415e+01,
                                            -0.3503288487499736816886487290e+00,
                                            0.3341791187130174790297318841e+00,
                                            0.8192320648511571246570742613e-01,
                                            -0.2235530786388629525884427845e-01};

/// Weights of the difference to the embedded solution of order 3, which takes stages 0, 8 and 11 only.
inline constexpr auto kError3 = [] {
  std::array<double, kStages> weights{};
  for (int i = 0; i < kStages; ++i) weights[i] = kB[i];
  weights[0] -= 0.244094488188976377952755905512;
  weights[8] -= 0.733846688281611857341361741547;
  weights[11] -= 0.220588235294117647058823529412e-1;
  return weights;
}();

namespace detail {

/// The sum of weights[i] k[i], the zero weights left out at compile time.
template <const auto& Weights, class State, class Stages, std::size_t... I>
inline State combine(const Stages& k, std::index_sequence<I...>) {
  State sum = State::Zero();
  (
      [&] {
        if constexpr (Weights[I] != 0.0) sum += Weights[I] * k[I];
      }(),
      ...);
  return sum;
}

template <int Row>
inline constexpr auto kRow = [] {
  std::array<double, Row> row{};
  for (int i = 0; i < Row; ++i) row[i] = kA[Row][i];
  return row;
}();

}  // namespace detail

/// What one step gave. The true error of `state` is far below the difference.
template <class State>
struct Step {
  State state;   ///< of order 8
  State error5;  ///< the difference to the solution of order 5
  State error3;  ///< to the one of order 3
};

/// One step of size h (of either sign) of the autonomous system x' = f(x), from x with `slope` = f(x) known: eleven
/// more evaluations of f. State is a fixed-size Eigen vector; nothing is allocated.
template <class State, class F>
Step<State> step(const State& x, const State& slope, double h, F&& f) {
  std::array<State, kStages> k;
  k[0] = slope;
  const auto stage = [&]<int Row>(std::integral_constant<int, Row>) {
    k[Row] = f(State(x + h * detail::combine<detail::kRow<Row>, State>(k, std::make_index_sequence<Row>())));
  };
  [&]<std::size_t... I>(std::index_sequence<I...>) { (stage(std::integral_constant<int, int(I) + 1>()), ...); }
  (std::make_index_sequence<kStages - 1>());
  constexpr auto kAll = std::make_index_sequence<kStages>();
  return {State(x + h * detail::combine<kB, State>(k, kAll)), State(h * detail::combine<kError5, State>(k, kAll)),
          State(h * detail::combine<kError3, State>(k, kAll))};
}

/// The error of a step in an equation whose solutions turn over a unit of their size, from the norm of the difference
/// to order 5, relative to that size: the difference falls as h^6, hence this as h^9, like the error. On geodesics
/// (wave, ellipsoid, torus) the true error's median is 7 times the power, and one step in a thousand has 8 times the
/// median. The estimate of Hairer, Norsett and Wanner (10.17), which weighs in a solution of order 3 and falls as h^8,
/// spreads by twice as many digits: steps that meet a tolerance are then shorter by a tenth. NaN if the difference is.
inline double error_estimate(double error5) {
  constexpr double kMedian = 7.0;
  return kMedian * error5 * std::sqrt(error5);
}

/// The error of a step that is too long for the orders to tell: where an equation's scale changes within the step (the
/// tail of a Gaussian), the differences to orders 5 and 3 are small and alike, and so is the error. It falls as h^9
/// too, and is a hundredth of error_estimate where that is right.
inline double unsettled_error(double error5, double error3) {
  const double gain = error5 / error3;
  return error5 * gain * std::sqrt(gain);
}

}  // namespace geovor::dop853
