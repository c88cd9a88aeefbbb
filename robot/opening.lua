-- A robot takes over its keys, atomically: what an earlier one sensed is cleared, what it left to do is told.
-- KEYS: commands, queue, record, map, odom, fiducials, lidar
-- ARGV: owner, how many bytes of an entry, how many digits of a number that was counted here
-- Returns {the record flat, the queue, how many commands wait, the last entry handled, the last entry taken}.
local commands, queue, record = unpack(KEYS, 1, 3)
local owner, bytes, digits = ARGV[1], tonumber(ARGV[2]), tonumber(ARGV[3])
local ROOM = digits + 1
local COUNT_MAX = 0.9 * 10 ^ digits  -- far beyond what can be counted to, and far from what it takes a digit more

for key, kind in pairs({[commands] = 'list', [queue] = 'list', [record] = 'hash'}) do
    local found = redis.call('TYPE', key).ok
    if found ~= 'none' and found ~= kind then redis.call('DEL', key) end
end
redis.call('LMOVE', commands, commands, 'LEFT', 'LEFT')  -- changes nothing, but a Redis before 6.2 refuses here
redis.call('DEL', unpack(KEYS, 4, 7))
redis.call('HSET', record, 'owner', owner)

local function counted(text)
    local number = text and #text <= digits and string.match(text, '^%d+$') and tonumber(text)
    return number and number < COUNT_MAX and number or nil
end

-- Junk in the robot's list was put there by somebody else, as was a number that was never given.
local seq = counted(redis.call('HGET', record, 'seq'))
local left, newest = {}, 0
for _, entry in ipairs(redis.call('LRANGE', queue, 0, -1)) do
    local number = counted(string.match(entry, '^(%d+) '))
    if number and number <= (seq or number) and #entry <= bytes + ROOM then
        left[#left + 1] = entry
        newest = math.max(newest, number)
    else
        redis.call('LREM', queue, 1, entry)
    end
end

-- Somebody may have changed the record: no number is given twice, and entries of which nothing is known count as
-- handled, so that they are not done a second time.
local taken = seq or newest
local handled = math.min(counted(redis.call('HGET', record, 'handled')) or taken, taken)
redis.call('HSET', record, 'seq', string.format('%.0f', taken), 'handled', string.format('%.0f', handled))
return {redis.call('HGETALL', record), left, redis.call('LLEN', commands), handled, taken}
