"""The parts of the simulated body: physics engine, stage, chassis and senses."""
