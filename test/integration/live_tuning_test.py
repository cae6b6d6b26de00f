#!/usr/bin/python3
"""dynamic_reconfigure, the services and ~fork show one and the same fork."""
import sys
import unittest

import rospy
import rostest
from dynamic_reconfigure.client import Client
from spring_workbench.msg import ForkState
from spring_workbench.srv import SetForkDamping, SetForkDofs, SetForkStiffness, SetIntegrator, SetIntegratorRequest

from stack import DEADLINE, Listener, wait_for


class LiveTuning(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.fork = Listener("manipulation/fork", ForkState)
        cls.client = Client("manipulation/live", timeout=DEADLINE)

    def test_a_start_uses_the_settings_not_what_was_left(self):
        state = self.fork.next()
        self.assertEqual((state.bend_stiffness, state.torsion_on), (500.0, True))

    def test_a_new_value_reaches_the_simulation(self):
        answer = self.client.update_configuration({"torsion": False, "bend_stiffness": 321.5, "stretch_damping": 0.25})
        self.assertEqual(answer["bend_stiffness"], 321.5)
        state = self.fork.next(lambda m: not m.torsion_on, "torsion to be off")
        self.assertEqual((state.bend_stiffness, state.stretch_damping_ratio, state.stretch_on), (321.5, 0.25, True))
        self.client.update_configuration({"torsion": True, "bend_stiffness": 0.0, "stretch_damping": 1.0})
        self.fork.next(lambda m: m.bend_stiffness == 0.0, "a spring of 0")
        self.client.update_configuration({"bend_stiffness": 500.0})
        self.fork.next(lambda m: m.torsion_on, "torsion to be on")

    def test_changes_by_services_are_shown(self):
        rospy.ServiceProxy("manipulation/set_stiffness", SetForkStiffness)(0.0, 0.0, 7.25, 0)
        rospy.ServiceProxy("manipulation/set_dofs", SetForkDofs)(False, True, True, 0)
        rospy.ServiceProxy("manipulation/set_integrator", SetIntegrator)("paper", 0.005, 0.0)
        shown = lambda: self.client.get_configuration(timeout=DEADLINE)
        wait_for(
            lambda: shown()["torsion_stiffness"] == 7.25
            and not shown()["stretch"]
            and shown()["integrator"] == "paper"
            and shown()["step"] == 0.005,
            "the changes to be shown",
        )

    def test_damping_values_are_those_of_the_law_in_force(self):
        set_damping = rospy.ServiceProxy("manipulation/set_damping", SetForkDamping)
        self.assertTrue(set_damping(3.0, 2.0, 0.01, "coefficients", 0).success)
        wait_for(lambda: self.client.get_configuration(timeout=DEADLINE)["bend_damping"] == 2.0, "the coefficients")
        self.client.update_configuration({"bend_damping": 50.0})
        state = self.fork.next(lambda m: m.bend_damping_coefficient == 50.0, "the new one")
        self.assertEqual((state.damping_law, state.torsion_damping_coefficient), ("coefficients", 0.01))
        self.assertTrue(set_damping(1.0, 1.0, 1.0, "modal", 0).success)
        wait_for(lambda: self.client.get_configuration(timeout=DEADLINE)["bend_damping"] == 1.0, "the ratios")
        self.assertEqual(self.client.update_configuration({"bend_damping": 11.0})["bend_damping"], 1.0)
        self.client.update_configuration({"bend_damping": 0.5})
        state = self.fork.next(lambda m: m.bend_damping_ratio == 0.5, "the new one")
        self.assertEqual(state.damping_law, "per_dof")
        self.assertTrue(set_damping(1.0, 1.0, 1.0, "", 0).success)

    def test_a_change_of_the_step_keeps_the_tolerance(self):
        set_integrator = rospy.ServiceProxy("manipulation/set_integrator", SetIntegrator)
        self.assertTrue(set_integrator("exponential", 0.02, 1e-5).success)
        self.assertEqual(self.client.update_configuration({"step": 0.01})["step"], 0.01)
        keep = SetIntegratorRequest.KEEP_TOLERANCE
        self.assertIn("steps of at most 0.01 s, tolerance 1e-5 m", set_integrator("exponential", 0.0, keep).message)

    def test_a_bad_value_rejects_the_good_one_too(self):
        before = self.fork.next()
        self.client.update_configuration({"bend_stiffness": 432.1, "integrator": "crystal_ball"})
        self.assertEqual(self.client.get_configuration(timeout=DEADLINE)["bend_stiffness"], before.bend_stiffness)

    def test_refused_values_are_reset(self):
        before = self.fork.next().integrator
        answer = self.client.update_configuration({"integrator": "crystal_ball"})
        self.assertEqual(answer["integrator"], before)
        answer = self.client.update_configuration({"bend_stiffness": float("nan")})
        self.assertGreater(answer["bend_stiffness"], 0.0)
        self.assertEqual(self.fork.next().integrator, before)


if __name__ == "__main__":
    rospy.init_node("live_tuning_test")
    rostest.rosrun("spring_workbench", "live_tuning_test", LiveTuning, sys.argv)
