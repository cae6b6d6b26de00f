#!/usr/bin/python3
"""contact_sound as run by a user: contacts in, a WAV file or the sound device out."""
import array
import contextlib
import os
import signal
import subprocess
import sys
import tempfile
import unittest
import wave

import roslib.packages
import rospy
import rostest
from spring_workbench.msg import BodyDescription, Contact, Contacts, SceneDescription

from stack import DEADLINE, wait_for

NODE = roslib.packages.find_node("spring_workbench", "contact_sound")[0]


class Player:
    def __init__(self, path=None, **environment):
        command = [NODE, *(["_file:=" + path] if path else [])]
        self.process = subprocess.Popen(
            command, env={**os.environ, **environment}, stderr=subprocess.PIPE, text=True
        )
        self.folder = os.path.dirname(path) if path else None

    @property
    def part(self):
        """The file that it writes, which has no name until it is complete."""
        files = "/proc/%d/fd" % self.process.pid
        for name in os.listdir(files):
            with contextlib.suppress(FileNotFoundError):  # closed meanwhile
                if os.readlink(os.path.join(files, name)).startswith(self.folder + "/#"):
                    return os.path.join(files, name)
        return ""

    def end(self):
        self.process.send_signal(signal.SIGINT)
        return self.process.communicate(timeout=DEADLINE)[1], self.process.returncode


def contact(phase, impulse=0.0, slip_speed=0.0):
    return Contacts(
        contacts=[Contact(object="box", other="workbench", phase=phase, impulse=impulse, slip_speed=slip_speed)]
    )


def loudest(part):
    """Largest sample so far in a file that is still being written."""
    with open(part, "rb") as file:
        recorded = file.read()[44:]  # behind the header
    return max(map(abs, array.array("h", recorded[: len(recorded) // 2 * 2])), default=0)


class ContactSound(unittest.TestCase):
    def setUp(self):
        self.publisher = rospy.Publisher("contacts", Contacts, queue_size=0)  # unbounded: it loses nothing itself

    def tearDown(self):
        wait_for(lambda: self.publisher.get_num_connections() == 0, "the player to be gone")
        if rospy.has_param("contact_sound"):
            rospy.delete_param("contact_sound")

    def record(self, player, seconds):
        """Waits until the file has grown by this much sound."""
        wait_for(lambda: os.path.exists(player.part), "the file")
        enough = os.path.getsize(player.part) + 2 * 44100 * seconds
        wait_for(lambda: os.path.getsize(player.part) >= enough, "%g s of sound" % seconds)

    def test_an_impact_and_a_scrape_are_in_the_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "sound.wav")
            player = Player(path)
            wait_for(lambda: self.publisher.get_num_connections() > 0, "the player to listen")
            self.record(player, 0.25)
            self.publisher.publish(contact(Contact.STARTED, impulse=0.5))
            self.record(player, 0.7)  # it rings out
            begin = os.path.getsize(player.part)
            while os.path.getsize(player.part) < begin + 2 * 44100:
                self.publisher.publish(contact(Contact.PERSISTING, slip_speed=0.5))
                self.record(player, 0.02)
            self.assertFalse(os.path.exists(path))
            player.end()
            self.assertEqual(os.listdir(folder), ["sound.wav"])
            with wave.open(path) as file:
                self.assertEqual((file.getnchannels(), file.getsampwidth(), file.getframerate()), (1, 2, 44100))
                samples = array.array("h", file.readframes(file.getnframes()))
        self.assertGreater(len(samples), 44100)
        first = next(i for i, s in enumerate(samples) if abs(s) > 500)
        ringing = samples[first : first + 2205]
        later = samples[first + 15000 : first + 20000]  # rung out, nothing slips yet
        scrape = samples[first + 50000 : first + 60000]
        loudness = lambda part: sum(s * s for s in part) / len(part)
        self.assertGreater(loudness(ringing), 100 * loudness(later) + 1)
        self.assertGreater(loudness(scrape), 100 * loudness(later) + 1)

    def struck(self, size, mass, compliance=0.0):
        """The first tenth of a second after a cube was struck."""
        moment = mass * size**2 / 6.0
        box = BodyDescription(name="box", movable=True, mass=mass, inertia=[moment, 0, 0, 0, moment, 0, 0, 0, moment])
        box.compliance = compliance
        scene = rospy.Publisher("scene_description", SceneDescription, queue_size=1, latch=True)
        scene.publish(SceneDescription(bodies=[box]))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "sound.wav")
            player = Player(path)
            for publisher in (self.publisher, scene):
                wait_for(lambda: publisher.get_num_connections() > 0, "the player to listen")
            self.record(player, 0.5)  # it has the description
            self.publisher.publish(contact(Contact.STARTED, impulse=0.5))
            self.record(player, 0.7)
            player.end()
            with wave.open(path) as file:
                samples = array.array("h", file.readframes(file.getnframes()))
        scene.unregister()
        self.tearDown()
        first = next(i for i, s in enumerate(samples) if abs(s) > 200)
        return samples[first : first + 4410]

    def test_a_large_box_sounds_lower_than_a_small_one(self):
        pitch = lambda sound: sum((a < 0) != (b < 0) for a, b in zip(sound, sound[1:]))
        self.assertLess(2 * pitch(self.struck(0.2, 5.0)), pitch(self.struck(0.05, 0.08)))

    def test_a_soft_box_sounds_duller_than_a_rigid_one(self):
        brightness = lambda s: sum((b - a) ** 2 for a, b in zip(s, s[1:])) / sum(a * a for a in s)
        self.assertLess(brightness(self.struck(0.06, 0.13, 1e-4)), 0.8 * brightness(self.struck(0.06, 0.13)))

    def test_no_impact_is_lost_while_the_machine_is_busy(self):
        """The player is stopped while an impact and two thousand more messages arrive: the impact is still played."""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "sound.wav")
            player = Player(path)
            wait_for(lambda: self.publisher.get_num_connections() > 0, "the player to listen")
            self.record(player, 0.25)
            player.process.send_signal(signal.SIGSTOP)
            self.publisher.publish(contact(Contact.STARTED, impulse=0.5))
            for _ in range(2000):
                self.publisher.publish(contact(Contact.PERSISTING))
            player.process.send_signal(signal.SIGCONT)
            wait_for(lambda: loudest(player.part) > 500, "the impact")
            player.end()

    def test_plays_on_a_device(self):
        player = Player(SDL_AUDIODRIVER="dummy")
        try:
            wait_for(
                lambda: self.publisher.get_num_connections() > 0 or player.process.poll() is not None,
                "the player to listen",
            )
        finally:
            said, status = player.end()
        if "built without SDL 2" in said:
            self.skipTest("built without SDL 2")
        self.assertEqual(status, 0, said)

    def test_bad_parameters_are_refused_in_one_line(self):
        for parameter, word in [("_volume:=2", "volume"), ("_file:=/nowhere/a.wav", "/nowhere/a.wav"), ("_x:=1", "x")]:
            process = subprocess.run([NODE, parameter], capture_output=True, text=True, timeout=DEADLINE)
            rospy.delete_param("contact_sound")
            self.assertEqual(process.returncode, 2)
            self.assertEqual(len(process.stderr.strip().splitlines()), 1, process.stderr)
            self.assertIn(word, process.stderr)


if __name__ == "__main__":
    rospy.init_node("contact_sound_test", disable_signals=True)
    rostest.rosrun("spring_workbench", "contact_sound_test", ContactSound, sys.argv)
