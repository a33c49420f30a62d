"""Closed forms over arrays, by what is known of them without their formulas."""
import unittest

import numpy as np

import phyllite
from phyllite import theory


class Theory(unittest.TestCase):
    theta = np.linspace(0.0, 90.0, 19)

    def test_arguments_are_broadcast(self):
        E = theory.goodman_E(self.theta[:, None], [50e9, 60e9], 40e9, 12e9)
        self.assertEqual(E.shape, (19, 2))
        self.assertEqual(E[4, 1], theory.goodman_E(self.theta[4], 60e9, 40e9, 12e9))
        self.assertIsInstance(theory.goodman_E(30, 60e9, 40e9, 12e9), float)

    def test_goodman_is_the_intact_rock_along_its_planes_and_softest_at_a_shoulder(self):
        E = theory.goodman_E(self.theta, 60e9, 40e9, 12e9)
        self.assertEqual(E[-1], 60e9)
        self.assertAlmostEqual(1 / E[0], 1 / 60e9 + 1 / 40e9)
        self.assertTrue(0 < np.argmin(E) < 18)
        np.testing.assert_allclose(theory.goodman_E(180 - self.theta, 60e9, 40e9, 12e9), E)
        stiff = theory.goodman_nu(self.theta, 60e9, np.inf, np.inf, 0.2)
        np.testing.assert_allclose(stiff, 0.2)

    def test_amadei_has_its_constants_at_both_ends_and_no_direction_where_isotropic(self):
        rock = dict(E=60e9, E_n=25e9, nu=0.2, nu_n=0.15, G_n=9e9)
        E = theory.amadei_E(self.theta, **rock)
        np.testing.assert_allclose(E[[0, -1]], [25e9, 60e9])
        np.testing.assert_allclose(theory.amadei_nu(0, **rock), 0.15)
        same = dict(E=60e9, E_n=60e9, nu=0.2, nu_n=0.2, G_n=25e9)
        np.testing.assert_allclose(theory.amadei_E(self.theta, **same), 60e9)
        self.assertAlmostEqual(theory.saint_venant_G(60e9, 60e9, 0.2) / 25e9, 1)

    def test_jaeger_is_capped_by_the_matrix(self):
        ucs = theory.jaeger_sigma_1(self.theta, 15e6, 25.0, 120e6)
        np.testing.assert_allclose(ucs[[0, -1]], 120e6)
        self.assertEqual(np.min(ucs), np.min(theory.weak_plane_sigma_1(self.theta, 15e6, 25.0)))
        self.assertTrue(np.isinf(theory.weak_plane_sigma_1(10.0, 15e6, 25.0)))
        least = theory.weak_plane_sigma_1(45 + 25 / 2, 15e6, 25.0)
        self.assertAlmostEqual(least / theory.coulomb_sigma_1(15e6, 25.0), 1)

    def test_discs_meet(self):
        rho = np.linspace(0.0, 0.9, 10)
        across, along = theory.hondros_loaded_diameter(rho, 1e6, 0.05, 5.0)
        self.assertLess(abs(across[0] / -theory.brazilian_strength(1e6, 0.05) - 1), 0.02)
        x, y, xy = theory.amadei_disc(0 * rho, 0.025 * rho, 1e6, 0.05, 5.0, 30.0, 60e9, 60e9, 0.2, 0.2, 25e9)
        np.testing.assert_allclose(x[:8], across[:8], rtol=1e-3)
        np.testing.assert_allclose(y[:8], along[:8], rtol=1e-3)
        np.testing.assert_allclose(xy, 0.0, atol=1e-3 * abs(across[0]))
        sides = theory.hondros_cross_diameter(-rho, 1e6, 0.05, 5.0)
        np.testing.assert_array_equal(sides, theory.hondros_cross_diameter(rho, 1e6, 0.05, 5.0))

    def test_fits_find_what_made_the_curve(self):
        fit = theory.fit_goodman(self.theta, theory.goodman_E(self.theta, 60e9, 40e9, 12e9))
        self.assertTrue(fit["ok"])
        np.testing.assert_allclose([fit["E"], fit["K_n_delta"], fit["K_s_delta"]], [60e9, 40e9, 12e9], rtol=1e-6)
        fit = theory.fit_jaeger(self.theta, theory.jaeger_sigma_1(self.theta, 15e6, 25.0, 120e6), 120e6)
        np.testing.assert_allclose([fit["cohesion"], fit["friction"]], [15e6, 25.0], rtol=0.01)
        refused = theory.fit_goodman([0.0, 90.0], [20e9, 60e9])
        self.assertFalse(refused["ok"])
        self.assertTrue(refused["reason"] and np.isnan(refused["E"]))
        with self.assertRaises(phyllite.InputError):
            theory.fit_jaeger([0.0, 45.0], [1e6])
