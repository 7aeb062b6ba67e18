# pandas: what a run held, by the names of its state's bits.
#     firmtouch-sim run demo.scenario --csv run.csv && python3 contact.py run.csv
import sys
import pandas

run = pandas.read_csv(sys.argv[1], keep_default_na=False)
run["force_N"] = (run[["force_N[0]", "force_N[1]", "force_N[2]"]] ** 2).sum(axis=1) ** 0.5
states = run["state_names"].str.get_dummies("|")  # a column of 0 and 1 a name
contact = run[states["contact"] == 1]
print(len(contact), "ticks in contact, largest force %.6f N" % contact["force_N"].max())
print(contact.groupby("faults_names")["force_N"].describe())
