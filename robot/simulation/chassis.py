"""The rolling part of the robot: a chassis on two driven wheels and two ball casters."""

from __future__ import annotations

import math

from robot import turtlebot3 as tb3
from robot.geometry import Pose

from .engine import FLOOR_GROUP, ROBOT_GROUP, STEP_RATE_HZ, pybullet

# ROBOTIS gives the centre of mass on the axle, where nothing would keep the nose up: there are casters only behind. The
# battery lies behind the axle, low between the plates.
_MASS_CENTRE_M = (-0.03, 0.0, 0.04)
_TYRE_FRICTION = 1.0  # rubber on a hard floor
_CASTER_FRICTION = 0.02  # balls roll with almost no resistance
# Through a gear of 212.6 : 1 (XM430-W210) the motor's rotor is felt as far more than the wheel itself.
_WHEEL_INERTIA_KGM2 = 1e-3
_CHASSIS, _LEFT, _RIGHT = -1, 0, 1
_WHEELS = [_LEFT, _RIGHT]
_ACROSS = pybullet.getQuaternionFromEuler([-math.pi / 2, 0, 0])  # turns an axis along z to lie along y
_STEP_S = 1 / STEP_RATE_HZ


class Chassis:
    """The robot's body in the engine. ``drive`` sets a target that ``advance`` approaches within the limits."""

    def __init__(self, start: Pose, client: int) -> None:
        self._client = client
        self.body = _spawn(start, client)
        self._target = (0.0, 0.0)
        self._command = (0.0, 0.0)
        self._turn_wheels()

    def drive(self, linear_mps: float, angular_radps: float) -> None:
        """Set the target; values beyond the limits are clipped.

        Raises:
            ValueError: a value is not a finite number.
        """
        if not math.isfinite(linear_mps) or not math.isfinite(angular_radps):
            raise ValueError(f"cannot drive at {linear_mps} m/s and {angular_radps} rad/s")
        fastest, quickest = tb3.LIMITS.linear_max_mps, tb3.LIMITS.angular_max_radps
        self._target = (max(-fastest, min(fastest, linear_mps)), max(-quickest, min(quickest, angular_radps)))

    def advance(self) -> None:
        """Bring the wheels' command one step nearer to the target. Call before each step of the engine."""
        if self._command == self._target:
            return
        linear = _approach(self._command[0], self._target[0], tb3.LIMITS.linear_acceleration_mps2 * _STEP_S)
        angular = _approach(self._command[1], self._target[1], tb3.LIMITS.angular_acceleration_radps2 * _STEP_S)
        self._command = (linear, angular)
        self._turn_wheels()

    def _turn_wheels(self) -> None:
        linear_mps, angular_radps = self._command
        apart_mps = angular_radps * tb3.WHEEL_SEPARATION_M / 2
        speeds = [(linear_mps - apart_mps) / tb3.WHEEL_RADIUS_M, (linear_mps + apart_mps) / tb3.WHEEL_RADIUS_M]
        pybullet.setJointMotorControlArray(
            self.body,
            _WHEELS,
            pybullet.VELOCITY_CONTROL,
            targetVelocities=speeds,
            forces=[tb3.WHEEL_TORQUE_MAX_NM] * 2,
            physicsClientId=self._client,
        )

    def wheels(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """(angle in radians, speed in rad/s) of the left and of the right wheel; forward is positive."""
        left, right = pybullet.getJointStates(self.body, _WHEELS, physicsClientId=self._client)
        return (left[0], left[1]), (right[0], right[1])

    def pose(self) -> Pose:
        """Where it truly is."""
        (x_m, y_m, _), (qx, qy, qz, qw) = pybullet.getBasePositionAndOrientation(
            self.body, physicsClientId=self._client
        )
        yaw_rad = math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))
        return Pose(x_m, y_m, yaw_rad).ahead(-_MASS_CENTRE_M[0])

    def touched(self) -> set[int]:
        """The engine's ids of the bodies that press against it now, the floor among them."""
        contacts = pybullet.getContactPoints(self.body, physicsClientId=self._client)
        return {contact[2] for contact in contacts if contact[9] > 0}


def _approach(value: float, target: float, change: float) -> float:
    return target if abs(target - value) <= change else value + math.copysign(change, target - value)


def _from_mass_centre(x_m: float, y_m: float, z_m: float) -> list[float]:
    return [x_m - _MASS_CENTRE_M[0], y_m - _MASS_CENTRE_M[1], z_m - _MASS_CENTRE_M[2]]


def _spawn(start: Pose, client: int) -> int:
    centre = start.ahead(_MASS_CENTRE_M[0])
    half_m = tb3.WHEEL_SEPARATION_M / 2
    tyre = pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=tb3.WHEEL_RADIUS_M, physicsClientId=client)
    body = pybullet.createMultiBody(
        baseMass=tb3.MASS_KG - 2 * tb3.WHEEL_MASS_KG,
        baseCollisionShapeIndex=_hull(client),
        basePosition=[centre.x_m, centre.y_m, _MASS_CENTRE_M[2]],
        baseOrientation=pybullet.getQuaternionFromEuler([0, 0, start.yaw_rad]),
        linkMasses=[tb3.WHEEL_MASS_KG] * 2,
        linkCollisionShapeIndices=[tyre, tyre],
        linkVisualShapeIndices=[-1, -1],
        linkPositions=[_from_mass_centre(0, side_m, tb3.WHEEL_RADIUS_M) for side_m in (half_m, -half_m)],
        linkOrientations=[_ACROSS, _ACROSS],
        linkInertialFramePositions=[[0, 0, 0]] * 2,
        linkInertialFrameOrientations=[[0, 0, 0, 1]] * 2,
        linkParentIndices=[0, 0],
        linkJointTypes=[pybullet.JOINT_REVOLUTE] * 2,
        linkJointAxis=[[0, 0, 1]] * 2,
        physicsClientId=client,
    )
    _set_dynamics(body, client)
    return int(body)


def _hull(client: int) -> int:
    """Everything that can bump into something: the chassis, the wheels (here just clear of the floor), the casters.

    What the wheels roll on is a ball in the middle of each tyre, which touches the floor in one point: the edge of a
    cylinder has several, whose friction makes the robot creep sideways as it turns.
    """
    half_m, wheel_m = tb3.WHEEL_SEPARATION_M / 2, tb3.WHEEL_RADIUS_M
    wheels = [_from_mass_centre(0, side_m, wheel_m) for side_m in (half_m, -half_m)]
    casters = [_from_mass_centre(x_m, y_m, tb3.CASTER_RADIUS_M) for x_m, y_m in tb3.CASTERS_M]
    return int(
        pybullet.createCollisionShapeArray(
            shapeTypes=[pybullet.GEOM_BOX] + [pybullet.GEOM_CYLINDER] * 2 + [pybullet.GEOM_SPHERE] * 2,
            halfExtents=[[side / 2 for side in tb3.CHASSIS_SIZE_M]] + [[0, 0, 0]] * 4,
            radii=[0] + [0.9 * wheel_m] * 2 + [tb3.CASTER_RADIUS_M] * 2,
            lengths=[0] + [tb3.WHEEL_WIDTH_M] * 2 + [0] * 2,
            collisionFramePositions=[_from_mass_centre(*tb3.CHASSIS_CENTRE_M), *wheels, *casters],
            collisionFrameOrientations=[[0, 0, 0, 1]] + [_ACROSS] * 2 + [[0, 0, 0, 1]] * 2,
            physicsClientId=client,
        )
    )


def _set_dynamics(body: int, client: int) -> None:
    for link in (_CHASSIS, *_WHEELS):
        pybullet.changeDynamics(body, link, linearDamping=0, angularDamping=0, jointDamping=0, physicsClientId=client)
    pybullet.changeDynamics(body, _CHASSIS, lateralFriction=_CASTER_FRICTION, physicsClientId=client)
    for wheel in _WHEELS:
        pybullet.changeDynamics(body, wheel, lateralFriction=_TYRE_FRICTION, physicsClientId=client)
        pybullet.changeDynamics(body, wheel, localInertiaDiagonal=[_WHEEL_INERTIA_KGM2] * 3, physicsClientId=client)
        pybullet.setCollisionFilterGroupMask(body, wheel, ROBOT_GROUP, FLOOR_GROUP, physicsClientId=client)
