"""Which of 10,000 random configurations collide: those that the learned model clears are passed over, the others are
checked exactly. Then all are, to see what that missed.

urdd generate ROBOT.urdf -o URDD --modules all,self_collision_model
python prune_then_check.py URDD [COUNT]
"""

import sys
import time

import urdd

robot = urdd.load(sys.argv[1])
model = robot.collision_model()
print(model)
# Not seed 0: the model was trained on configurations of that seed.
q = robot.random(int(sys.argv[2]) if len(sys.argv) > 2 else 10_000, seed=1)
robot.in_collision(q[0])  # reads the meshes before the timing starts

begin = time.process_time()
found = model.may_collide(q)
print(f"{(~found).sum()} of {len(q)} cleared, {found.sum()} checked exactly")
found[found] = robot.in_collision(q[found])
pruned = time.process_time() - begin

begin = time.process_time()
exact = robot.in_collision(q)
checked = time.process_time() - begin

print(f"{found.sum()} collisions found, {exact.sum()} there: {(exact & ~found).sum()} missed")
print(f"{pruned:.3f} s of processor time, {checked:.3f} s without the model")
