"""How much of the bare simulator's speed is left when the whole simulated robot runs.

One loop drives `PybulletBody` in a circle with its laser at 5 Hz, its camera at 2 Hz and the markers read out of each
picture; the other makes only the same pybullet calls, with their arguments computed beforehand: steps, motor
control, the laser's rays and the camera's pictures. Both start from the same state of the same world and take turns, so
that a noisy machine slows both; the figures are medians over the rounds.

Run as ``kirby bench simulation [--json]``.
"""

from __future__ import annotations

import resource
import statistics
import time
from dataclasses import dataclass
from importlib.resources import files

from robot import turtlebot3 as tb3
from robot.fiducials import FiducialDetector
from robot.geometry import Pose
from robot.pybullet_body import PybulletBody
from robot.simulation.chassis import Chassis
from robot.simulation.engine import STEP_RATE_HZ, connect, pybullet
from robot.simulation.senses import CAMERA_SETTINGS, camera_view, laser_rays
from robot.simulation.stage import build_stage
from voxml.scene import Scene, find_scene

ROUNDS = 9
ROUND_S = 4.0
PERIOD_S = 0.05
LINEAR_MPS, ANGULAR_RADPS = 0.20, 0.40  # a circle of half a metre, clear of the walls


@dataclass(frozen=True, slots=True)
class Moment:
    """What is sensed after one control period, and from where."""

    pose: Pose
    scans: bool
    pictures: bool


def run(rounds: int = ROUNDS, round_s: float = ROUND_S) -> dict[str, float]:
    """Simulated seconds for each second of both loops, their ratio, and the peak memory of the process."""
    scene = find_scene("figure3", files("corpora").joinpath("worlds"))
    whole, bare = [], []
    for _ in range(rounds):
        moments, seconds = _whole_loop(scene, round_s)
        whole.append(round_s / seconds)
        bare.append(round_s / _bare_loop(scene, moments))
    return {
        "simulated_seconds_per_second": round(statistics.median(whole), 2),
        "bare_simulated_seconds_per_second": round(statistics.median(bare), 2),
        "ratio": round(statistics.median(w / b for w, b in zip(whole, bare, strict=True)), 3),
        "rounds": rounds,
        "simulated_seconds_each": round_s,
        "peak_memory_mb": round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024, 1),
    }


def _whole_loop(scene: Scene, round_s: float) -> tuple[list[Moment], float]:
    body = PybulletBody(scene)
    detector = FiducialDetector(body.camera, scene.marker_size_m)
    moments = []
    seconds = 0.0
    body.drive(LINEAR_MPS, ANGULAR_RADPS)
    for _ in range(round(round_s / PERIOD_S)):
        began = time.perf_counter()
        body.step(PERIOD_S)
        body.odometry()
        scan = body.scan()
        image = body.image()
        if image is not None:
            detector.detect(image)
        seconds += time.perf_counter() - began
        moments.append(Moment(body.truth(), scan is not None, image is not None))
    body.close()
    return moments, seconds


def _bare_loop(scene: Scene, moments: list[Moment]) -> float:
    client = connect()
    build_stage(scene, client)
    chassis = Chassis(Pose(scene.start.x_m, scene.start.y_m, scene.start.yaw_rad), client)
    senses = [
        (laser_rays(moment.pose) if moment.scans else None, camera_view(moment.pose) if moment.pictures else None)
        for moment in moments
    ]
    steps = range(round(PERIOD_S * STEP_RATE_HZ))
    apart_mps = ANGULAR_RADPS * tb3.WHEEL_SEPARATION_M / 2
    speeds = [speed / tb3.WHEEL_RADIUS_M for speed in (LINEAR_MPS - apart_mps, LINEAR_MPS + apart_mps)]
    began = time.perf_counter()
    pybullet.setJointMotorControlArray(
        chassis.body, [0, 1], pybullet.VELOCITY_CONTROL, targetVelocities=speeds, physicsClientId=client
    )
    for rays, view in senses:
        for _ in steps:
            pybullet.stepSimulation(physicsClientId=client)
        if rays is not None:
            pybullet.rayTestBatch(*rays, physicsClientId=client)
        if view is not None:
            pybullet.getCameraImage(viewMatrix=view, physicsClientId=client, **CAMERA_SETTINGS)
    seconds = time.perf_counter() - began
    pybullet.disconnect(physicsClientId=client)
    return seconds
